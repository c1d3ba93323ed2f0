capstan_widget_test(
  NAME figures_test
  SOURCES figures_curve_test.cpp figures_day_test.cpp figures_export_test.cpp figures_header_test.cpp figures_history_test.cpp
          figures_joint_test.cpp figures_theme_test.cpp figures_views_test.cpp
  LINKS capstan::figures)

capstan_widget_test(
  NAME figure_sheets_test
  SOURCES figures/export_all_test.cpp figures/figure_numbers_test.cpp figures/figure_pictures_test.cpp
          figures/figure_vectors_test.cpp
  LINKS capstan::figures)

capstan_widget_test(
  NAME diagnosis_figures_test
  SOURCES figures/diagnosis_export_test.cpp figures/diagnosis_figures_test.cpp
  LINKS capstan::figures capstan_sample_diagnosis nlohmann_json::nlohmann_json)

capstan_widget_test(
  NAME figure_layout_test
  SOURCES figures/figure_layout_test.cpp
  LINKS capstan::figures capstan_sample_diagnosis)
