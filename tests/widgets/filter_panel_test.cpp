#include <gtest/gtest.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>

#include "core/base/yaml.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/filter/filter_panel.h"

namespace capstan::widgets {
namespace {

using tracking::TrackingOptions;

class Filter : public testing::Test {
 protected:
  Filter() {
    panel_.resize(420, 340);
    panel_.show();
    QObject::connect(&panel_, &FilterPanel::changed,
                     [this](const TrackingOptions& options, const QString& name) {
                       asked_.push_back(options);
                       name_ = name;
                     });
  }
  ~Filter() override { applyTheme(*qApp, Theme::dark()); }
  QPushButton& button(const QString& text) {
    for (auto* each : panel_.findChildren<QPushButton*>())
      if (each->text() == text) return *each;
    ADD_FAILURE() << text.toStdString();
    return *panel_.findChild<QPushButton*>();
  }

  FilterPanel panel_;
  std::vector<TrackingOptions> asked_;
  QString name_;
  QTemporaryDir folder_;
};

TEST_F(Filter, ReportsOneChangedOptionAndKeepsTheOthers) {
  auto* ray = panel_.findChild<QComboBox*>("one_camera");
  EXPECT_FALSE(ray->isEnabled()) << "no session";
  TrackingOptions source;
  source.camera_delay = 0.0125;
  source.nis_window = 77;
  panel_.begin(source);
  ASSERT_TRUE(ray->isEnabled());
  EXPECT_TRUE(asked_.empty()) << "a session is no change";
  EXPECT_EQ(panel_.findChild<QDoubleSpinBox*>("camera_delay")->value(), 12.5);
  test::grab(panel_, "filter_as_in_source");
  QTest::keyClick(ray, Qt::Key_Down);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].one_camera, tracking::OneCamera::kRay);
  EXPECT_EQ(asked_[0].nis_window, 77);
  EXPECT_EQ(name_, "one camera blocked");
  EXPECT_EQ(panel_.words(), "Other than in the source: one_camera: ray");
  auto* delay = panel_.findChild<QDoubleSpinBox*>("camera_delay");
  delay->selectAll();
  QTest::keyClicks(delay, "-20");
  EXPECT_EQ(asked_.size(), 1u) << "a half-typed number is no change";
  QTest::keyClick(delay, Qt::Key_Return);
  ASSERT_EQ(asked_.size(), 2u);
  EXPECT_DOUBLE_EQ(asked_[1].camera_delay, -0.02);
  EXPECT_EQ(asked_[1].one_camera, tracking::OneCamera::kRay);
  test::grab(panel_, "filter_changed_dark");
  applyTheme(*qApp, Theme::light());
  panel_.setTheme(Theme::light());
  test::grab(panel_, "filter_changed_light");
  button("As in the source").click();
  EXPECT_EQ(base::writeYaml(asked_.back()), base::writeYaml(source));
  EXPECT_FALSE(button("As in the source").isEnabled());
}

TEST_F(Filter, TakesAFileOrSaysWhatIsWrongWithIt) {
  panel_.begin({});
  const QString file = folder_.filePath("options.yaml");
  base::writeTextFile(file.toStdString(), "gate_probability: 0.95\ncamera_delay: 0.03\n");
  panel_.load(file);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_EQ(asked_[0].gate_probability, 0.95);
  EXPECT_EQ(panel_.findChild<QDoubleSpinBox*>("gate_probability")->value(), 0.95);
  EXPECT_EQ(name_, "options of options.yaml");
  base::writeTextFile(file.toStdString(), "gate_probability: 1.95\n");
  panel_.load(file);
  EXPECT_EQ(asked_.size(), 1u);
  EXPECT_TRUE(panel_.words().contains("options.yaml:1")) << panel_.words().toStdString();
  EXPECT_EQ(panel_.options().gate_probability, 0.95);
}

}  // namespace
}  // namespace capstan::widgets
