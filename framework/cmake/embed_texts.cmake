# SPDX-License-Identifier: BSD-3-Clause
# Text files that go into the program, so that it needs nothing beside itself.

# cambium_embed(FOLDER HEADER FUNCTION): writes <FUNCTION>.cpp, which defines
# const std::map<std::string, std::string>& cambium::FUNCTION() with the files of FOLDER by name.
function(cambium_embed folder header function)
  file(GLOB names CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/${folder}
       ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*)
  set(table "")
  foreach(name IN LISTS names)
    set(file ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${name})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(APPEND table "      {\"${name}\", R\"template(${text})template\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp @ONLY CONTENT
"// SPDX-License-Identifier: BSD-3-Clause
// Made by framework/cmake/embed_texts.cmake.
#include \"@header@\"

namespace cambium {

const std::map<std::string, std::string>& @function@() {
  static const std::map<std::string, std::string> files = {
@table@  };
  return files;
}

}  // namespace cambium
")
endfunction()
