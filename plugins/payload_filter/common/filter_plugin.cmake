# SPDX-License-Identifier: BSD-3-Clause
# add_filter_plugin(NAME SOURCES a.cpp... TEST test.cpp...): a plugin on what is shared here.
macro(add_filter_plugin name)
  find_package(cambium REQUIRED)
  if(NOT TARGET cambium_filter_common)
    add_subdirectory(${CMAKE_CURRENT_SOURCE_DIR}/../common ${CMAKE_CURRENT_BINARY_DIR}/common)
  endif()
  cambium_add_plugin(${name} ${ARGN} LINK cambium_filter_common)
endmacro()
