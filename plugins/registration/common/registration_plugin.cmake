# SPDX-License-Identifier: BSD-3-Clause
# add_registration_plugin(NAME [LINK lib...]): a plugin of one source NAME.cpp on what is shared here.
macro(add_registration_plugin name)
  find_package(cambium REQUIRED)
  if(NOT TARGET cambium_registration_common)
    add_subdirectory(${CMAKE_CURRENT_SOURCE_DIR}/../common ${CMAKE_CURRENT_BINARY_DIR}/common)
  endif()
  cambium_add_plugin(${name} SOURCES ${name}.cpp LINK cambium_registration_common ${ARGN} TEST test.cpp)
  if(TARGET test_${name})  # the laws that every registration keeps
    target_include_directories(test_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/..)
  endif()
endmacro()
