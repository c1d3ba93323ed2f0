capstan_widget_test(
  NAME panels_test
  SOURCES errors_panel_test.cpp notes_panel_test.cpp status_line_test.cpp
  LINKS capstan::errors_panel capstan::notes_panel capstan::status_line)
