# SPDX-License-Identifier: BSD-3-Clause
# The files of `cambium plugins new` go into the program, so that it needs nothing beside itself.
file(GLOB templates CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/templates
     ${CMAKE_CURRENT_SOURCE_DIR}/templates/*)
set(table "")
foreach(name IN LISTS templates)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/templates/${name})
  file(READ ${CMAKE_CURRENT_SOURCE_DIR}/templates/${name} text)
  string(APPEND table "      {\"${name}\", R\"template(${text})template\"},\n")
endforeach()
set(CAMBIUM_TEMPLATES_CPP ${CMAKE_CURRENT_BINARY_DIR}/templates.cpp)
file(CONFIGURE OUTPUT ${CAMBIUM_TEMPLATES_CPP} @ONLY CONTENT
"// SPDX-License-Identifier: BSD-3-Clause
// Made by framework/cmake/embed_templates.cmake.
#include \"plugins/templates.hpp\"

namespace cambium {

const std::map<std::string, std::string>& plugin_templates() {
  static const std::map<std::string, std::string> files = {
@table@  };
  return files;
}

}  // namespace cambium
")
