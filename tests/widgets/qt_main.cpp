#include <gtest/gtest.h>

#include <QApplication>

#include "widgets/figures/theme.h"

/// GoogleTest around a QApplication. Listing tests needs no display and no application.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (GTEST_FLAG_GET(list_tests)) return RUN_ALL_TESTS();
#ifdef CAPSTAN_TEST_OFFSCREEN
  qputenv("QT_QPA_PLATFORM", "offscreen");
#else
  qputenv("QT_QPA_PLATFORM", "xcb");
#endif
  QApplication application(argc, argv);
  capstan::widgets::applyTheme(application, capstan::widgets::Theme::dark());
  return RUN_ALL_TESTS();
}
