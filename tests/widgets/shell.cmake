capstan_widget_test(
  NAME shell_test
  SOURCES shell_again_test.cpp shell_choice_test.cpp shell_disk_test.cpp shell_motors_test.cpp shell_sessions_test.cpp shell_window_test.cpp
  LINKS capstan::shell)
target_compile_definitions(shell_test PRIVATE CAPSTAN_CLI="$<TARGET_FILE:capstan-cli>")
add_dependencies(shell_test capstan-cli)
