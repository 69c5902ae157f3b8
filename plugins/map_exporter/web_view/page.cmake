# SPDX-License-Identifier: BSD-3-Clause
# Bundles page/ with Node.js. Sets WEB_VIEW_PAGE to a C++ source with the finished page; or leaves it
# empty, with the reason in WEB_VIEW_WHY.
include(${CMAKE_CURRENT_LIST_DIR}/npm.cmake)
set(WEB_VIEW_PAGE "")
set(source ${CMAKE_CURRENT_SOURCE_DIR}/page)
set(work ${CMAKE_CURRENT_BINARY_DIR}/page)
npm_packages(${source} ${work} WEB_VIEW_WHY)
if(WEB_VIEW_WHY)
  return()
endif()
set(WEB_VIEW_PAGE ${CMAKE_CURRENT_BINARY_DIR}/page_files.cpp)
file(GLOB web_view_parts CONFIGURE_DEPENDS ${source}/* ${source}/src/*)
add_custom_command(OUTPUT ${WEB_VIEW_PAGE}
  COMMAND ${NODE} ${source}/build.mjs ${work}/node_modules ${WEB_VIEW_PAGE}
  DEPENDS ${web_view_parts} COMMENT "Bundling the page of web_view" VERBATIM)
