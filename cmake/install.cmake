# `cmake --install`: the program, the library with its headers, and what find_package(ident) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(ident_package ${CMAKE_INSTALL_LIBDIR}/cmake/ident)

install(TARGETS ident RUNTIME)
install(TARGETS ident_lib EXPORT ident_targets)
install(DIRECTORY src/ident ${PROJECT_BINARY_DIR}/generated/ident TYPE INCLUDE
        FILES_MATCHING PATTERN "*.h" PATTERN "*.def" PATTERN node_modules EXCLUDE)
install(EXPORT ident_targets NAMESPACE ident:: DESTINATION ${ident_package})

configure_package_config_file(cmake/ident-config.cmake.in ${PROJECT_BINARY_DIR}/ident-config.cmake
                              INSTALL_DESTINATION ${ident_package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ident-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ident-config.cmake ${PROJECT_BINARY_DIR}/ident-config-version.cmake
        DESTINATION ${ident_package})
