capstan_widget_test(NAME analysis_panel_test SOURCES analysis_panel_test.cpp LINKS capstan::analysis)
