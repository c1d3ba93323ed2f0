// Wrong cameras in the window: the registration names what is wrong, and its button puts it right.
#include <QAction>
#include <QDockWidget>
#include <QPushButton>

#include "core/registration/stereo_fault.h"
#include "core/simulation/simulated_source.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/registration/camera_strip.h"
#include "widgets/panels/registration/collect_page.h"
#include "widgets/panels/registration/registration_panel.h"

namespace capstan::widgets {
namespace {

/// A simulated robot whose images come wrong, or whose calibration has a wrong base line.
class WrongCameras final : public tracking::Source {
 public:
  WrongCameras(const simulation::SimulationRequest& request, const vision::ImageCorrection& wrong,
               double scale)
      : source_(simulation::optionsOf(request)), wrong_(wrong), info_(source_.info()) {
    info_.rig = registration::scaledBaseline(*info_.rig, scale);
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    if (!source_.next(out)) return false;
    if (auto* frame = std::get_if<tracking::StereoFrame>(&out)) wrong_.apply(frame->left, frame->right);
    return true;
  }
  void block(bool left, bool right) override {
    blocked = {left, right};
    wrong_.exchange ? source_.block(right, left) : source_.block(left, right);
  }
  std::array<bool, 2> blocked{};

 private:
  simulation::SimulatedSource source_;
  vision::ImageCorrection wrong_;
  tracking::SourceInfo info_;
};

class CameraWindow : public Shell {
 protected:
  void begin(const std::string& trajectory, const vision::ImageCorrection& wrong, double scale = 1.0) {
    window_ = makeWindow();
    window_->bar().setSpeed(5.0);
    simulation::SimulationRequest request;
    request.trajectory = trajectory;
    request.registered = false;
    request.duration = 600.0;
    auto source = std::make_unique<WrongCameras>(request, wrong, scale);
    source_ = source.get();
    window_->link().take(std::move(source));
    window_->link().setRunning(true);
    window_->action("register")->trigger();
    panel_ = window_->findChild<RegistrationPanel*>();
    ASSERT_TRUE(panel_->isVisible());
  }
  QPushButton* remedy() { return panel_->findChild<QPushButton*>("cameraRemedy"); }
  bool offers(const QString& button, const QString& reason) {
    return waitFor([&] {
      return remedy()->isVisible() && remedy()->text() == button &&
             panel_->cameras().remedies().contains(reason);
    });
  }
  bool fits() {
    return waitFor([&] {
      const auto* finding = panel_->cameras().checks()->finding();
      return finding->verdict == registration::StereoVerdict::kFits;
    });
  }
  std::string said() {
    return panel_->cameras().text("geometry").toStdString() + " | " +
           panel_->cameras().remedies().toStdString();
  }

  std::unique_ptr<MainWindow> window_;
  RegistrationPanel* panel_ = nullptr;
  WrongCameras* source_ = nullptr;
};

TEST_F(CameraWindow, GoodCamerasPassEveryCheck) {
  ASSERT_NO_FATAL_FAILURE(begin("sinusoid", {}));
  ASSERT_TRUE(fits()) << said();
  EXPECT_TRUE(waitFor([&] {
    for (const char* check : {"images", "same time", "focus", "exposure", "marker", "geometry"})
      if (!panel_->cameras().text(check).startsWith("✓")) return false;
    return true;
  })) << panel_->cameras().remedies().toStdString();
  EXPECT_TRUE(panel_->cameras().remedies().isEmpty()) << panel_->cameras().remedies().toStdString();
  test::grab(*panel_, "cameras_good");
}

TEST_F(CameraWindow, ExchangedCamerasAreExchangedByTheButtonWhichUndoTakesBack) {
  ASSERT_NO_FATAL_FAILURE(begin("hard-stop", {true, {}, {}}));
  ASSERT_TRUE(offers("Exchange the cameras", "exchanged")) << said();
  test::grab(*panel_, "cameras_exchanged");
  QTest::mouseClick(remedy(), Qt::LeftButton);
  EXPECT_TRUE(waitFor([&] {
    return window_->link().runner()->report().gates[static_cast<std::size_t>(tracking::Gate::kUnregistered)] >
           0;
  }));
  EXPECT_TRUE(waitFor([&] { return !remedy()->isVisible(); })) << said();
  EXPECT_TRUE(window_->notes().row(window_->notes().rows() - 1).contains("cameras exchanged"));
  window_->link().runner()->block(true, false);
  EXPECT_TRUE(waitFor([&] {
    return source_->blocked == (std::array<bool, 2>{false, true});
  })) << "the left camera is the source's right one";
  window_->link().runner()->block(false, false);
  window_->action("undo")->trigger();
  EXPECT_TRUE(offers("Exchange the cameras", "exchanged")) << said();
}

TEST_F(CameraWindow, TheRefusedCollectionOffersTheExchangeToo) {
  ASSERT_NO_FATAL_FAILURE(begin("hard-stop", {true, {}, {}}));
  const auto button = [this](const QString& text) {
    for (auto* one : panel_->findChildren<QPushButton*>())
      if (one->text() == text && one != remedy()) return one;
    return static_cast<QPushButton*>(nullptr);
  };
  ASSERT_TRUE(waitFor([&] { return button("Collect frames")->isEnabled(); }));
  button("Collect frames")->click();
  ASSERT_TRUE(waitFor([&] { return panel_->guide()->step() == registration::RegistrationStep::kRefused; }));
  auto* exchange = panel_->findChild<QPushButton*>("exchange");
  ASSERT_TRUE(exchange->isVisible());
  QTest::mouseClick(exchange, Qt::LeftButton);
  ASSERT_TRUE(waitFor([&] { return button("Collect frames")->isEnabled(); }));
  button("Collect frames")->click();
  ASSERT_TRUE(waitFor([&] { return panel_->guide()->step() == registration::RegistrationStep::kReview; }))
      << panel_->guide()->reason();
}

TEST_F(CameraWindow, MirroredImagesAreCorrectedByTheButton) {
  ASSERT_NO_FATAL_FAILURE(begin("sinusoid", {false, {true, true}, {}}));
  ASSERT_TRUE(offers("Correct the images", "both images mirrored")) << said();
  test::grab(*panel_, "cameras_mirrored");
  QTest::mouseClick(remedy(), Qt::LeftButton);
  ASSERT_TRUE(fits()) << said();
  EXPECT_FALSE(remedy()->isVisible());
}

TEST_F(CameraWindow, AWrongBaseLineIsScaledByTheButtonAndRecorded) {
  ASSERT_NO_FATAL_FAILURE(begin("sinusoid", {}, 0.8));  // squares of 25 mm that were entered as 20 mm
  const double wrong = window_->link().runner()->info().rig->baseline();
  ASSERT_TRUE(offers("Scale the base line", "wrong base line or board")) << said();
  test::grab(*panel_, "cameras_wrong_board");
  QTest::mouseClick(remedy(), Qt::LeftButton);
  ASSERT_TRUE(fits()) << said();
  const auto rig = window_->link().runner()->infoInUse().rig;
  EXPECT_NEAR(rig->baseline(), wrong / 0.8, 0.03 * wrong);
  const auto header = window_->link().runner()->inUse({});
  EXPECT_NEAR(vision::parseStereoRig(header.camera_left, header.camera_right).baseline(), rig->baseline(),
              1e-9);
}

}  // namespace
}  // namespace capstan::widgets
