capstan_widget_test(NAME occlusion_panel_test SOURCES occlusion_panel_test.cpp LINKS capstan::occlusion)
