capstan_widget_test(NAME calibration_panel_test SOURCES calibration_panel_test.cpp
                    LINKS capstan::calibration capstan::simulation)
capstan_display_test(NAME calibration_window_test SOURCES calibration_window_test.cpp LINKS capstan::shell)
