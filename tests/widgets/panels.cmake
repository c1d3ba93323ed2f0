capstan_widget_test(
  NAME panels_test
  SOURCES errors_panel_test.cpp health_panel_test.cpp notes_panel_test.cpp status_line_test.cpp
  LINKS capstan::errors_panel capstan::health_panel capstan::notes_panel capstan::status_line)
capstan_widget_test(NAME replay_bar_test SOURCES replay_bar_test.cpp LINKS capstan::replay_panel capstan::tracking)
capstan_widget_test(NAME filter_panel_test SOURCES filter_panel_test.cpp LINKS capstan::filter_panel)
