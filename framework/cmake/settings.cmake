# SPDX-License-Identifier: BSD-3-Clause
# How this tree is compiled. Nothing here reaches a partner's build.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
option(CAMBIUM_BUILD_TESTS "Build the tests" ON)
option(CAMBIUM_BUILD_BENCH "Build the benchmarks" OFF)
set(CAMBIUM_SANITIZE "" CACHE STRING "address or thread: instrument everything")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
add_compile_options(-Wall -Wextra -Wpedantic -Wnon-virtual-dtor)

if(CAMBIUM_SANITIZE)
  add_compile_options(-fsanitize=${CAMBIUM_SANITIZE} -fno-omit-frame-pointer -g1)
  add_link_options(-fsanitize=${CAMBIUM_SANITIZE})
  if(CAMBIUM_SANITIZE STREQUAL address)
    # Eigen allocates otherwise under this sanitizer, but the libraries (PCL) that hand us Eigen's memory were not
    # built with it.
    add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
    add_compile_options(-fsanitize=undefined -fno-sanitize-recover=undefined)
    add_link_options(-fsanitize=undefined)
  endif()
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

include(GNUInstallDirs)
set(CAMBIUM_PLUGIN_SUBDIR cambium/plugins)
set(CAMBIUM_PLUGIN_DESTINATION ${CMAKE_INSTALL_LIBDIR}/${CAMBIUM_PLUGIN_SUBDIR})
set(CAMBIUM_PLUGIN_OUTPUT ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${CAMBIUM_PLUGIN_SUBDIR})
