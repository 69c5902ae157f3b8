# SPDX-License-Identifier: BSD-3-Clause
# add_columns_plugin(NAME SOURCES a.cpp... [LINK lib...]): a recogniser on what is shared here.
macro(add_columns_plugin name)
  find_package(cambium REQUIRED)
  if(NOT TARGET cambium_columns)
    add_subdirectory(${CMAKE_CURRENT_SOURCE_DIR}/../common ${CMAKE_CURRENT_BINARY_DIR}/common)
  endif()
  cambium_add_plugin(${name} ${ARGN} TEST test.cpp)
  target_link_libraries(${name} PRIVATE cambium_columns)
endmacro()
