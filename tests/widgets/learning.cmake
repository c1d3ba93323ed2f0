capstan_widget_test(NAME learning_panel_test CASES SOURCES learning_panel_test.cpp LINKS capstan::learning_panel
                    capstan_sample_poses)
add_dependencies(learning_panel_test capstan-cli)
capstan_display_test(NAME learning_window_test SOURCES learning_window_test.cpp LINKS capstan::shell
                     capstan_sample_poses)
capstan_widget_test(NAME experiments_panel_test SOURCES experiments_panel_test.cpp LINKS capstan::experiments_panel
                    capstan_sample_poses)
