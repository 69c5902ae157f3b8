# SPDX-License-Identifier: BSD-3-Clause
# add_gnss_plugin(NAME SOURCES a.cpp...): an aligner on what is shared here.
macro(add_gnss_plugin name)
  find_package(cambium REQUIRED)
  if(NOT TARGET cambium_gnss_common)
    add_subdirectory(${CMAKE_CURRENT_SOURCE_DIR}/../common ${CMAKE_CURRENT_BINARY_DIR}/common)
  endif()
  cambium_add_plugin(${name} ${ARGN} TEST test.cpp)
  target_link_libraries(${name} PRIVATE cambium_gnss_common)
  if(TARGET test_${name})  # the receivers that every test simulates
    target_include_directories(test_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/..)
  endif()
endmacro()
