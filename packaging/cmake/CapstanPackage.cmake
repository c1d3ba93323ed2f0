# The build folder as a CMake package: find_package(capstan) with capstan_DIR set to it gives capstan::ROOM for each
# room of core/; with COMPONENTS figures those of widgets/ too, and Qt. CapstanInstall.cmake installs the same package.
get_property(rooms GLOBAL PROPERTY CAPSTAN_ROOMS)
set_target_properties(capstan_options PROPERTIES EXPORT_NAME options)
export(TARGETS capstan_options ${rooms} NAMESPACE capstan:: FILE ${PROJECT_BINARY_DIR}/capstan-targets.cmake)
set(CAPSTAN_CMAKE_FOLDER ${PROJECT_SOURCE_DIR}/packaging/cmake)
configure_file(${CAPSTAN_CMAKE_FOLDER}/capstan-config.cmake.in ${PROJECT_BINARY_DIR}/capstan-config.cmake @ONLY)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/capstan-config-version.cmake COMPATIBILITY SameMinorVersion)
