# SPDX-License-Identifier: BSD-3-Clause
# cambium_test_plugin(TARGET)
#
# Adds the test conformance.TARGET: every component of the plugin against the laws of its kind. The
# program is that of the package, or of this tree. Does nothing where the program is not there.
function(cambium_test_plugin target)
  if(TARGET cambium_cli)
    set(program $<TARGET_FILE:cambium_cli>)
  elseif(CAMBIUM_EXECUTABLE)
    set(program ${CAMBIUM_EXECUTABLE})
  else()
    message(STATUS "conformance.${target} is left out: the program 'cambium' was not found")
    return()
  endif()
  set(path ${CAMBIUM_PLUGIN_OUTPUT})
  if(path)
    set(path --plugin-path ${path})
  endif()
  add_test(NAME conformance.${target} COMMAND ${program} plugins check $<TARGET_FILE:${target}> ${path})
endfunction()
