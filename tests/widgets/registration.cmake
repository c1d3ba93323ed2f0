capstan_test(NAME registration_guide_test SOURCES registration_guide_test.cpp LINKS capstan::session)
capstan_widget_test(NAME registration_panel_test SOURCES registration_panel_test.cpp LINKS capstan::registration
                    opencv_imgproc)
