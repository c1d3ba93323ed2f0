capstan_widget_test(NAME analysis_panel_test SOURCES analysis_export_test.cpp analysis_panel_test.cpp LINKS capstan::analysis_panel)
capstan_display_test(NAME analysis_window_test SOURCES analysis_window_test.cpp LINKS capstan::shell)
capstan_display_test(NAME analysis_numbers_test SOURCES analysis_numbers_test.cpp LINKS capstan::shell)
