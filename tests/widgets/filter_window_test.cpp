// Filter options in the window: they reach the pipeline, stay when the session begins again, and are undone.
#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <future>

#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/filter/filter_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"

namespace capstan::widgets {
namespace {

class FilterWindow : public Shell {
 protected:
  void begin() {
    window_ = makeWindow();
    window_->bar().setSpeed(5.0);
    window_->open(atRest());
    ASSERT_TRUE(opened(*window_));
    window_->action("view_filter")->trigger();
    panel_ = window_->findChild<FilterPanel*>();
    ASSERT_TRUE(panel_->isVisible());
  }
  /// Options of the pipeline itself.
  tracking::TrackingOptions inUse() {
    std::promise<tracking::TrackingOptions> promise;
    auto future = promise.get_future();
    window_->link().runner()->post([&](tracking::Source&, tracking::TrackingPipeline& pipeline) {
      promise.set_value(pipeline.options());
    });
    waitFor([&] { return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    return future.get();
  }
  template <class Box = QDoubleSpinBox>
  Box& box(const char* key) {
    return *panel_->findChild<Box*>(key);
  }

  std::unique_ptr<MainWindow> window_;
  FilterPanel* panel_ = nullptr;
};

TEST_F(FilterWindow, OptionsLatencyAndGateAreUndoneAndMadeAgain) {
  ASSERT_NO_FATAL_FAILURE(begin());
  auto *undo = window_->action("undo"), *redo = window_->action("redo");
  EXPECT_FALSE(undo->isEnabled());
  box("gate_probability").setValue(0.95);
  box("camera_delay").setValue(25.0);
  box<QComboBox>("one_camera").setCurrentText("ray");
  EXPECT_EQ(inUse().gate_probability, 0.95);
  EXPECT_EQ(inUse().camera_delay, 0.025);
  EXPECT_EQ(inUse().one_camera, tracking::OneCamera::kRay);
  EXPECT_TRUE(window_->notes().row(window_->notes().rows() - 1).contains("one_camera: ray"));
  EXPECT_TRUE(undo->text().contains("one camera blocked")) << undo->text().toStdString();
  test::grab(*window_->findChild<QDockWidget*>("filter"), "filter_dock");
  undo->trigger();
  EXPECT_EQ(inUse().one_camera, tracking::OneCamera::kKinematics);
  EXPECT_EQ(box<QComboBox>("one_camera").currentText(), "kinematics");
  EXPECT_EQ(inUse().camera_delay, 0.025);
  undo->trigger();
  EXPECT_EQ(inUse().camera_delay, 0.0);
  EXPECT_EQ(box("camera_delay").value(), 0.0);
  undo->trigger();
  EXPECT_EQ(inUse().gate_probability, tracking::TrackingOptions{}.gate_probability);
  EXPECT_FALSE(undo->isEnabled());
  redo->trigger();
  redo->trigger();
  EXPECT_EQ(inUse().gate_probability, 0.95);
  EXPECT_EQ(inUse().camera_delay, 0.025);
  EXPECT_EQ(window_->link().runner()->tracking().camera_delay, 0.025);
}

TEST_F(FilterWindow, OneBlockedCameraIsObservedByTheRayOfTheOther) {
  ASSERT_NO_FATAL_FAILURE(begin());
  box<QComboBox>("one_camera").setCurrentText("ray");
  auto* occlusion = window_->findChild<OcclusionPanel*>();
  occlusion->setSchedule({80.0, 2.0, 0.0, live::BlockedCameras::kLeft});
  Q_EMIT occlusion->scheduleChanged(occlusion->schedule());
  EXPECT_TRUE(waitFor([&] {
    const auto blocked = window_->link().runner()->status().blocked;
    return blocked[0] && !blocked[1] && occlusion->observation() == "now: observing a single ray";
  })) << occlusion->observation().toStdString();
  test::grab(*window_, "filter_one_ray");
  box<QComboBox>("one_camera").setCurrentText("kinematics");
  EXPECT_TRUE(waitFor([&] { return occlusion->observation() == "now: observing the motors (q_kin)"; }))
      << occlusion->observation().toStdString();
}

TEST_F(FilterWindow, ASessionThatBeginsAgainKeepsThemAndAnotherDoesNot) {
  ASSERT_NO_FATAL_FAILURE(begin());
  box("gate_probability").setValue(0.9);
  window_->open(window_->lastSource());
  ASSERT_TRUE(
      waitFor([&] { return window_->link().again() && stateOf(*window_) == live::RunState::kRunning; }));
  QApplication::processEvents();
  EXPECT_EQ(inUse().gate_probability, 0.9);
  EXPECT_EQ(box("gate_probability").value(), 0.9);
  window_->open(atRest(300.0));
  ASSERT_TRUE(
      waitFor([&] { return !window_->link().again() && stateOf(*window_) == live::RunState::kRunning; }));
  EXPECT_EQ(inUse().gate_probability, tracking::TrackingOptions{}.gate_probability);
  EXPECT_EQ(box("gate_probability").value(), tracking::TrackingOptions{}.gate_probability);
  EXPECT_FALSE(window_->action("undo")->isEnabled());
}

}  // namespace
}  // namespace capstan::widgets
