capstan_widget_test(
  NAME shell_test CASES
  SOURCES shell_again_test.cpp shell_books_test.cpp shell_choice_test.cpp shell_compare_test.cpp shell_disk_test.cpp shell_drive_test.cpp live_dialog_test.cpp shell_monitor_test.cpp shell_motors_test.cpp shell_recover_test.cpp shell_replay_test.cpp shell_sessions_test.cpp shell_window_test.cpp shell_refusal_test.cpp
  LINKS capstan::shell nlohmann_json::nlohmann_json opencv_videoio PkgConfig::HTTPLIB)
add_dependencies(shell_test capstan-cli)
capstan_widget_test(NAME registration_window_test CASES SOURCES camera_window_test.cpp filter_window_test.cpp registration_window_test.cpp LINKS capstan::shell)
add_dependencies(registration_window_test capstan-cli)

# In a real window, at the size of a small screen and with every pixel doubled.
capstan_display_test(
  NAME shell_reach_test
  SOURCES shell_operator_test.cpp shell_reach_test.cpp
  LINKS capstan::shell)
add_dependencies(shell_reach_test capstan-cli)
add_test(NAME shell_reach_doubled_test COMMAND xvfb-run -a -s "-screen 0 1920x1080x24 -noreset"
                                               $<TARGET_FILE:shell_reach_test> --gtest_filter=Reach.*)
set_tests_properties(shell_reach_doubled_test PROPERTIES TIMEOUT 120 ENVIRONMENT "QT_SCALE_FACTOR=2")

capstan_display_test(NAME first_session_test SOURCES shell_first_session_test.cpp LINKS capstan::shell)
set_tests_properties(first_session_test PROPERTIES TIMEOUT 500)
