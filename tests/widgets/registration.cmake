capstan_widget_test(NAME registration_panel_test SOURCES registration_panel_test.cpp LINKS capstan::registration_panel
                    opencv_imgproc)
