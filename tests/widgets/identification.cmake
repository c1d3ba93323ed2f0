capstan_widget_test(NAME identification_panel_test SOURCES identification_panel_test.cpp
                    LINKS capstan::identification_panel capstan::simulation capstan::recording nlohmann_json::nlohmann_json)
add_dependencies(identification_panel_test capstan-cli)
capstan_display_test(NAME identification_window_test SOURCES identification_window_test.cpp LINKS capstan::shell)
