# SPDX-License-Identifier: BSD-3-Clause
# cambium_add_plugin(NAME SOURCES a.cpp... [LINK lib...] [TEST test.cpp [NO_CHECK]])
#
# One shared library that exports one symbol, `cambium_plugin`. The library is named NAME.so. TEST is
# a GoogleTest file, built where the test support of Cambium is at hand; NO_CHECK: the
# folder calls cambium_test_plugin() itself, with arguments. `cmake --install` puts the
# library where a cambium of the same prefix looks for it (CAMBIUM_PLUGIN_DESTINATION; empty: no rule).
function(cambium_add_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_CHECK" "" "SOURCES;LINK;TEST")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOURCES)
    message(FATAL_ERROR "cambium_add_plugin(${name}): expected SOURCES, got ${arg_UNPARSED_ARGUMENTS}")
  endif()
  add_library(${name} MODULE ${arg_SOURCES})
  target_compile_features(${name} PRIVATE cxx_std_20)
  target_link_libraries(${name} PRIVATE cambium::cambium ${arg_LINK})
  set_target_properties(${name} PROPERTIES
    PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LINK_DEPENDS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/plugin.map)
  target_link_options(${name} PRIVATE -Wl,--version-script=${CMAKE_CURRENT_FUNCTION_LIST_DIR}/plugin.map)
  if(NOT CAMBIUM_SANITIZE)  # sanitizers leave their symbols to the executable
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  if(CAMBIUM_PLUGIN_OUTPUT)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CAMBIUM_PLUGIN_OUTPUT})
  endif()
  if(CAMBIUM_PLUGIN_DESTINATION)
    install(TARGETS ${name} LIBRARY DESTINATION ${CAMBIUM_PLUGIN_DESTINATION})
  endif()
  if(arg_TEST AND TARGET cambium_test_support)
    add_executable(test_${name} ${arg_TEST})
    target_link_libraries(test_${name} PRIVATE cambium_test_support)
    add_dependencies(test_${name} ${name})
    add_test(NAME plugin.${name} COMMAND test_${name})
    set_tests_properties(plugin.${name} PROPERTIES SKIP_REGULAR_EXPRESSION "\\[  SKIPPED \\] .* listed below")
    if(NOT arg_NO_CHECK)
      cambium_test_plugin(${name})
    endif()
  endif()
endfunction()
