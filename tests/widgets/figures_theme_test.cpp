#include <gtest/gtest.h>

#include <QEvent>
#include <QLabel>
#include <cmath>

#include "widgets/figures/theme.h"

namespace capstan::widgets {
namespace {

/// WCAG 2.1 relative luminance and contrast ratio.
double luminance(const QColor& colour) {
  const auto linear = [](double c) { return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

double contrast(const QColor& a, const QColor& b) {
  const double x = luminance(a) + 0.05, y = luminance(b) + 0.05;
  return std::max(x, y) / std::min(x, y);
}

class ThemeTest : public testing::TestWithParam<const char*> {
 protected:
  const Theme& theme_ = Theme::named(GetParam());
};

TEST(Contrast, OfBlackOnWhiteIs21) { EXPECT_NEAR(contrast(Qt::black, Qt::white), 21.0, 1e-9); }

TEST_P(ThemeTest, TextIsLegibleOnEveryGround) {
  for (const QColor& ground : {theme_.surface, theme_.window, theme_.raised}) {
    EXPECT_GE(contrast(theme_.text, ground), 7.0) << ground.name().toStdString();
    EXPECT_GE(contrast(theme_.muted, ground), 4.5) << ground.name().toStdString();
  }
  EXPECT_GE(contrast(theme_.on_accent, theme_.accent), 4.5);
}

TEST_P(ThemeTest, ColouredWordsAreLegibleOnEveryGround) {
  const QColor colours[] = {theme_.warning,
                            theme_.fault,
                            theme_.muted,
                            theme_.colour(Quantity::kKinematic),
                            theme_.colour(Quantity::kCamera),
                            theme_.colour(Quantity::kUkf)};
  for (const QColor& colour : colours)
    for (const QColor& ground : {theme_.surface, theme_.window, theme_.raised}) {
      EXPECT_GE(contrast(theme_.inkOf(colour), ground), 4.5)
          << colour.name().toStdString() << " on " << ground.name().toStdString();
      EXPECT_NEAR(contrastOf(colour, ground), contrast(colour, ground), 1e-12);
    }
  EXPECT_EQ(theme_.inkOf(theme_.text).name(), theme_.text.name()) << "legible as it is";
}

TEST_P(ThemeTest, DarkWordsStandOnWarningsAndFaults) {
  const QColor ink = Theme::dark().on_accent;
  EXPECT_GE(contrast(ink, theme_.warning), 4.5);
  EXPECT_GE(contrast(ink, theme_.fault), 4.5);
}

TEST_P(ThemeTest, QuantitiesKeepTheirColourAndAreToldApartByLine) {
  EXPECT_EQ(theme_.colour(Quantity::kKinematic), QColor("#D55E00"));
  EXPECT_EQ(theme_.colour(Quantity::kCamera), QColor("#56B4E9"));
  EXPECT_EQ(theme_.colour(Quantity::kUkf), QColor("#009E73"));
  EXPECT_GE(contrast(theme_.colour(Quantity::kTrue), theme_.surface), 15.0);
  const QPen truth = theme_.pen(Quantity::kTrue), kinematic = theme_.pen(Quantity::kKinematic),
             ukf = theme_.pen(Quantity::kUkf);
  EXPECT_LT(truth.widthF() + 1.0, kinematic.widthF() + 1e-9) << "dashes show on both sides of the truth";
  EXPECT_LT(kinematic.widthF() + 1.0, ukf.widthF()) << "the filter's line shows on both sides of a dash";
  EXPECT_EQ(kinematic.style(), Qt::DashLine);
  EXPECT_EQ(ukf.style(), Qt::SolidLine);
}

/// Counts how often Qt computes the style of a widget.
class StyledLabel : public QLabel {
 public:
  int styled() const { return styled_; }

 private:
  bool event(QEvent* event) override {
    styled_ += event->type() == QEvent::StyleChange;
    return QLabel::event(event);
  }
  int styled_ = 0;
};

TEST(Restyle, ComputesStylesOnlyForAnotherStyleSheet) {
  StyledLabel label;
  label.ensurePolished();
  restyle(label, "color: red;");
  const int once = label.styled();
  EXPECT_GT(once, 0);
  restyle(label, "color: red;");
  EXPECT_EQ(label.styled(), once);
  restyle(label, "color: blue;");
  EXPECT_GT(label.styled(), once);
  EXPECT_EQ(label.styleSheet(), "color: blue;");
}

INSTANTIATE_TEST_SUITE_P(Themes, ThemeTest, testing::Values("dark", "light"));

}  // namespace
}  // namespace capstan::widgets
