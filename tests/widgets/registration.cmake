capstan_widget_test(NAME registration_panel_test SOURCES registration_panel_test.cpp LINKS capstan::registration_panel
                    opencv_imgproc)
capstan_widget_test(NAME history_page_test SOURCES history_page_test.cpp LINKS capstan::registration_panel)
capstan_widget_test(NAME poses_page_test SOURCES poses_page_test.cpp LINKS capstan::registration_panel)
capstan_widget_test(NAME calibration_panel_test SOURCES calibration_panel_test.cpp LINKS capstan::calibration_panel opencv_imgproc opencv_imgcodecs opencv_aruco)
capstan_widget_test(NAME marker_panel_test SOURCES marker_panel_test.cpp LINKS capstan::marker_panel opencv_imgproc)
