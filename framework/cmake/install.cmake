# SPDX-License-Identifier: BSD-3-Clause
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/cambium)
install(TARGETS cambium EXPORT cambiumTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS cambium_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/cambium ${CAMBIUM_GENERATED_INCLUDE}/cambium DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT cambiumTargets NAMESPACE cambium:: DESTINATION ${package_dir})
configure_package_config_file(cmake/cambiumConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/cambiumConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/cambiumConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
configure_file(cmake/cambium.pc.in ${CMAKE_CURRENT_BINARY_DIR}/cambium.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/cambium.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/cambiumConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/cambiumConfigVersion.cmake
              cmake/cambium_add_plugin.cmake cmake/cambium_test_plugin.cmake cmake/plugin.map DESTINATION ${package_dir})
