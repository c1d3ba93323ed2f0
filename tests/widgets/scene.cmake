capstan_display_test(NAME scene_window_test SOURCES scene_window_test.cpp LINKS capstan::scene)
capstan_widget_test(NAME scene_test SOURCES scene_camera_test.cpp scene_shape_test.cpp LINKS capstan::scene)
