# SPDX-License-Identifier: BSD-3-Clause
# add_registration_plugin(NAME SOURCES a.cpp... [LINK lib...]): a plugin on what is shared here.
macro(add_registration_plugin name)
  cmake_parse_arguments(registration "" "" "SOURCES;LINK" ${ARGN})
  find_package(cambium REQUIRED)
  if(NOT TARGET cambium_registration_common)
    add_subdirectory(${CMAKE_CURRENT_SOURCE_DIR}/../common ${CMAKE_CURRENT_BINARY_DIR}/common)
  endif()
  cambium_add_plugin(${name} SOURCES ${registration_SOURCES}
                     LINK cambium_registration_common ${registration_LINK} TEST test.cpp)
  if(TARGET test_${name})  # the laws that every registration keeps
    target_include_directories(test_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/..)
  endif()
endmacro()
