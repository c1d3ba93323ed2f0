capstan_widget_test(NAME video_test SOURCES video_layout_test.cpp video_roi_test.cpp LINKS capstan::video opencv_imgproc)
