# Third-party libraries of widgets/ and app/, all from Debian 12 (packages: packaging/packages-run.txt).
find_package(CLI11 REQUIRED)
find_package(Qt5 5.15 REQUIRED COMPONENTS Widgets Test PrintSupport Svg)
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel CommonTransforms FiltersSources FiltersCore
                                         FiltersGeneral InteractionStyle RenderingCore RenderingFreeType RenderingOpenGL2)
find_package(QCustomPlot REQUIRED)
find_package(glfw3 3.3 REQUIRED)
find_package(Freetype REQUIRED)
find_package(Fontconfig REQUIRED)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
