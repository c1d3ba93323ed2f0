# What `cmake --install` installs, by components that are the Debian packages: capstan (the window), capstan-cli with the
# resources, capstan-monitor, libcapstan-dev, python3-capstan (app/python) and, with CAPSTAN_ROS_LIBRARY, capstan-ros. Installed programs find
# share/capstan relative to their own folder, so that the prefix may be moved.
include(GNUInstallDirs)
get_property(rooms GLOBAL PROPERTY CAPSTAN_ROOMS)

if(CAPSTAN_ROS_LIBRARY)
  include(CapstanRosLibrary)
endif()

foreach(program capstan capstan-cli capstan-monitor)
  install(TARGETS ${program} RUNTIME COMPONENT ${program})
endforeach()

install(DIRECTORY resources/ DESTINATION ${CMAKE_INSTALL_DATADIR}/capstan COMPONENT capstan-cli PATTERN desktop EXCLUDE)
install(DIRECTORY resources/manual/examples DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/libcapstan-dev COMPONENT libcapstan-dev)

set(desktop resources/desktop)
install(FILES ${desktop}/capstan.desktop ${desktop}/capstan-session.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT capstan)
install(FILES ${desktop}/capstan.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT capstan)
install(FILES ${desktop}/capstan.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/mimetypes COMPONENT capstan
        RENAME application-x-capstan-session.svg)
install(FILES ${desktop}/capstan.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT capstan)
install(FILES ${desktop}/capstan.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT capstan)
install(FILES ${desktop}/capstan.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers COMPONENT capstan)

# The library: static, its headers below include/capstan as they are included, and the package for find_package(capstan).
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/capstan)
install(TARGETS capstan_options ${rooms} EXPORT capstan-targets ARCHIVE COMPONENT libcapstan-dev)
install(EXPORT capstan-targets NAMESPACE capstan:: DESTINATION ${package} COMPONENT libcapstan-dev)
install(DIRECTORY core widgets DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/capstan COMPONENT libcapstan-dev
        FILES_MATCHING PATTERN *.h)
set(CAPSTAN_CMAKE_FOLDER "\${CMAKE_CURRENT_LIST_DIR}")
configure_file(packaging/cmake/capstan-config.cmake.in ${PROJECT_BINARY_DIR}/install/capstan-config.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/install/capstan-config.cmake ${PROJECT_BINARY_DIR}/capstan-config-version.cmake
              packaging/cmake/CapstanLibraryDependencies.cmake packaging/cmake/CapstanProgramDependencies.cmake
              packaging/cmake/CapstanRos.cmake
        DESTINATION ${package} COMPONENT libcapstan-dev)
