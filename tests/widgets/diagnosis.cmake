capstan_widget_test(NAME diagnosis_panel_test SOURCES diagnosis_panel_test.cpp diagnosis_pages_test.cpp LINKS capstan::diagnosis_panel
                    capstan_sample_diagnosis)
capstan_display_test(NAME diagnosis_window_test SOURCES diagnosis_window_test.cpp LINKS capstan::shell
                     capstan_sample_diagnosis)
capstan_widget_test(NAME diagnosis_run_test CASES SOURCES diagnosis_run_test.cpp LINKS capstan::diagnosis_panel
                    capstan_sample_diagnosis)
add_dependencies(diagnosis_run_test capstan-cli)
