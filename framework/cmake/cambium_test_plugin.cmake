# SPDX-License-Identifier: BSD-3-Clause
# cambium_test_plugin(TARGET [NAME name] [ARGUMENT...])
#
# Adds the test conformance.NAME (TARGET if there is none): every component of the plugin against the laws of its kind, as
# `cambium plugins check` does with these arguments. The program is that of the package, or of this
# tree. Does nothing where the program is not there.
function(cambium_test_plugin target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAME" "")
  if(NOT arg_NAME)
    set(arg_NAME ${target})
  endif()
  if(TARGET cambium_cli)
    set(program $<TARGET_FILE:cambium_cli>)
  elseif(CAMBIUM_EXECUTABLE)
    set(program ${CAMBIUM_EXECUTABLE})
  else()
    message(STATUS "conformance.${arg_NAME} is left out: the program 'cambium' was not found")
    return()
  endif()
  set(path ${CAMBIUM_PLUGIN_OUTPUT})
  if(path)
    set(path --plugin-path ${path})
  endif()
  add_test(NAME conformance.${arg_NAME} COMMAND ${program} plugins check $<TARGET_FILE:${target}> ${path}
           ${arg_UNPARSED_ARGUMENTS})
endfunction()
