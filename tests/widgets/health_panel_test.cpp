// The panel of the estimator's health: a headline, a row per check, advice where a check does not pass.
#include "widgets/panels/health/health_panel.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <cmath>

#include "tests/widgets/picture.h"
#include "widgets/panels/health/nis_plot.h"

namespace capstan::widgets {
namespace {

using tracking::HealthCheck;
using tracking::HealthVerdict;

std::vector<HealthCheck> someChecks() {
  return {{"nis_q1", "NIS of shoulder", HealthVerdict::kPass, "1.05", "0.4 to 2.5; 1 where σ is right", ""},
          {"transmission", "transmission and cameras", HealthVerdict::kCautious,
           "joint 1: cable travel +6.97 ± 0.10 % of nominal (pulley radius)", "no error found",
           "A constant of the robot file is wrong: identify it."},
          {"encoders", "motor encoders", HealthVerdict::kFail, "motor 2: frozen since 31.2 s", "all in use",
           "The joint is estimated from the camera alone. Check the encoder and its cable."},
          {"lost", "lost samples", HealthVerdict::kPass, "0", "none", ""}};
}

tracking::InnovationRecord someRecord() {
  tracking::InnovationRecord record;
  for (int i = 0; i < 900; ++i) {
    const double t = i / 15.0, wave = 1.0 + 0.8 * std::sin(0.2 * t);
    record.add(t, Eigen::Vector3d(wave, 0.5 * wave, 3.0 * wave), Eigen::Vector3d::Ones());
  }
  return record;
}

QStringList textsOf(const HealthPanel& panel) {
  QStringList texts;
  for (const QLabel* label : panel.findChildren<QLabel*>())
    if (!label->isHidden()) texts << label->text();
  return texts;
}

TEST(HealthPanelTest, SaysThatNothingIsJudgedYet) {
  HealthPanel panel;
  EXPECT_EQ(panel.headline(), "Nothing has been tracked yet");
  EXPECT_EQ(panel.plot().points(), 0);
}

TEST(HealthPanelTest, ShowsTheWorstVerdictAndAdviceOnlyWhereItIsNeeded) {
  HealthPanel panel;
  panel.showHealth(someChecks(), someRecord());
  EXPECT_EQ(panel.headline(), "✗ FAIL");
  EXPECT_EQ(panel.plot().points(), 60);
  const QStringList texts = textsOf(panel);
  for (const char* words : {"NIS of shoulder", "✓ pass", "! cautious", "motor 2: frozen since 31.2 s",
                            "A constant of the robot file is wrong: identify it."})
    EXPECT_TRUE(texts.contains(words)) << words;
  EXPECT_FALSE(texts.contains("")) << "a passed check leaves no empty row of advice";
  panel.showHealth({someChecks().front()}, {});
  EXPECT_EQ(panel.headline(), "✓ pass");
  EXPECT_FALSE(textsOf(panel).contains("motor encoders")) << "rows of a former session are gone";
}

TEST(HealthPanelTest, APassDoesNotHideWhatIsNotJudged) {
  HealthPanel panel;
  auto checks = std::vector<HealthCheck>{someChecks().front(), someChecks().back()};
  checks.front().verdict = HealthVerdict::kUnknown;
  panel.showHealth(checks, {});
  EXPECT_EQ(panel.headline(), "✓ pass · 1 of 2 checks unknown");
}

TEST(HealthPanelTest, Pictures) {
  for (const Theme& theme : {Theme::dark(), Theme::light()}) {
    HealthPanel panel;
    applyTheme(*qApp, theme);
    panel.setTheme(theme);
    panel.showHealth(someChecks(), someRecord());
    panel.resize(560, 560);
    panel.show();
    const QImage image = test::grab(panel, "health_" + theme.name);
    EXPECT_GT(test::count(image, image.rect(), theme.inkOf(theme.fault), 8).pixels, 20)
        << "FAIL has its colour";
  }
  applyTheme(*qApp, Theme::dark());
}

}  // namespace
}  // namespace capstan::widgets
