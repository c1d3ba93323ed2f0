// Commands to a real robot, in the window: armed by a person, sent while a key is held, stopped by
// everything.
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QDockWidget>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <chrono>
#include <mutex>

#include "core/live/robot_commands.h"
#include "core/simulation/simulation_request.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/status/status_line.h"

namespace capstan::widgets {
namespace {

using live::DriveState;
using live::DriveStop;

/// Commands whose drive has motors all the time, and that go nowhere.
class Commands final : public live::RobotCommands {
 public:
  void arm() override {
    act([](live::ArmedDrive& drive, double now) { drive.arm(now); });
  }
  void disarm() override {
    act([](live::ArmedDrive& drive, double) { drive.disarm(); });
  }
  void hold() override {
    ++holds;
    act([](live::ArmedDrive& drive, double now) { drive.hold(now); });
  }
  void release() override {
    act([](live::ArmedDrive& drive, double) { drive.release(); });
  }
  void stop(DriveStop cause) override {
    act([cause](live::ArmedDrive& drive, double) { drive.stop(cause); });
  }
  live::CommandStatus status() const override {
    const_cast<Commands*>(this)->act([this](live::ArmedDrive& drive, double now) {
      if (const auto point = drive.step(now)) q_ = *point;
    });
    const std::lock_guard lock(mutex_);
    return {drive_.state(), drive_.reason(), "/arm/servo_jp", 0};
  }

  std::atomic<int> holds = 0;

 private:
  template <class Act>
  void act(const Act& what) {
    const std::lock_guard lock(mutex_);
    const double now =
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    drive_.observe(now, q_);
    what(drive_, now);
  }
  mutable std::mutex mutex_;
  mutable Eigen::Vector3d q_{0.8, 1.5, 0.4};  ///< follows at once
  live::ArmedDrive drive_{robot::defaultDescription(), {0.01, 0.01, 0.001}};
};

/// A robot at rest that may be commanded.
class CommandedSource final : public tracking::Source, public live::Commandable {
 public:
  explicit CommandedSource(std::shared_ptr<Commands> commands)
      : commands_(std::move(commands)), robot_(simulation::optionsOf(request())), info_(robot_.info()) {
    info_.live = false;
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override { return robot_.next(out); }
  void block(bool left, bool right) override { robot_.block(left, right); }
  std::shared_ptr<live::RobotCommands> commands() const override { return commands_; }

 private:
  static simulation::SimulationRequest request() {
    simulation::SimulationRequest request;
    request.trajectory = "hold";
    request.duration = 600.0;
    return request;
  }
  const std::shared_ptr<Commands> commands_;
  simulation::SimulatedSource robot_;
  tracking::SourceInfo info_;
};

class ShellDrive : public Shell {
 protected:
  void begin() {
    window_ = makeWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    window_->link().take(std::make_unique<CommandedSource>(commands_));
    ASSERT_TRUE(opened(*window_));
    window_->action("register")->trigger();
    ASSERT_TRUE(waitFor([&] { return button("drive_stop")->isVisible(); }));
  }
  QPushButton* button(const char* name) const { return window_->findChild<QPushButton*>(name); }
  QCheckBox* nobodyNear() const { return window_->findChild<QCheckBox*>("drive_clear"); }
  QString statusText() const { return window_->findChild<StatusLine*>()->text(); }
  QString stateText() const { return window_->findChild<QLabel*>("drive_state")->text(); }
  bool noted(const QString& words) const {
    for (int row = 0; row < window_->notes().rows(); ++row)
      if (window_->notes().row(row).contains(words)) return true;
    return false;
  }
  DriveState state() const { return commands_->status().state; }
  void key(QEvent::Type type, int code, bool repeats = false) const {
    QKeyEvent event(type, code, Qt::NoModifier, QString(), repeats);
    QWidget* receiver = QApplication::focusWidget() ? QApplication::focusWidget() : window_.get();
    QApplication::sendEvent(receiver, &event);
  }
  void arm() {
    nobodyNear()->setChecked(true);
    QTest::mouseClick(button("drive_arm"), Qt::LeftButton);
    ASSERT_EQ(state(), DriveState::kArmed) << commands_->status().reason;
  }
  void armAndHold() {
    ASSERT_NO_FATAL_FAILURE(arm());
    key(QEvent::KeyPress, Qt::Key_F8);
    ASSERT_EQ(state(), DriveState::kMoving);
  }
  void expectStopped(const QString& reason) {
    EXPECT_EQ(state(), DriveState::kStopped);
    EXPECT_TRUE(waitFor([&] { return statusText().contains("robot stopped: " + reason); }))
        << statusText().toStdString();
    EXPECT_TRUE(noted("robot stopped: " + reason));
    const int before = commands_->holds;
    QTest::qWait(150);
    EXPECT_EQ(commands_->holds, before) << "the key is not renewed any more";
  }

  const std::shared_ptr<Commands> commands_ = std::make_shared<Commands>();
  std::unique_ptr<MainWindow> window_;
};

TEST_F(ShellDrive, ASimulationHasNoCommandsToARealRobot) {
  const auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->action("register")->trigger();
  QTest::qWait(200);
  EXPECT_FALSE(window->findChild<QPushButton*>("drive_stop")->isVisible());
  EXPECT_FALSE(window->findChild<StatusLine*>()->text().contains("commands"));
}

TEST_F(ShellDrive, MovesOnlyWhileArmedAndTheKeyIsHeld) {
  ASSERT_NO_FATAL_FAILURE(begin());
  EXPECT_FALSE(button("drive_arm")->isEnabled()) << "first somebody looks at the arm";
  EXPECT_FALSE(button("drive_hold")->isEnabled());
  key(QEvent::KeyPress, Qt::Key_F8);
  key(QEvent::KeyRelease, Qt::Key_F8);
  EXPECT_EQ(state(), DriveState::kDisarmed);

  ASSERT_NO_FATAL_FAILURE(arm());
  EXPECT_TRUE(waitFor([&] { return statusText().contains("commands armed"); })) << statusText().toStdString();
  EXPECT_TRUE(noted("commands armed"));
  QTest::qWait(200);
  EXPECT_EQ(state(), DriveState::kArmed);

  key(QEvent::KeyPress, Qt::Key_F8);
  for (int k = 0; k < 10; ++k) {  // longer than a key that is not renewed
    QTest::qWait(40);
    key(QEvent::KeyRelease, Qt::Key_F8, true);
    key(QEvent::KeyPress, Qt::Key_F8, true);
    if (state() != DriveState::kMoving) key(QEvent::KeyPress, Qt::Key_F8);  // this computer was too busy
    ASSERT_EQ(state(), DriveState::kMoving) << k;
  }
  EXPECT_TRUE(statusText().contains("THE ROBOT IS DRIVEN")) << statusText().toStdString();
  EXPECT_TRUE(noted("driven to the hard stop by /arm/servo_jp"));
  key(QEvent::KeyRelease, Qt::Key_F8);
  EXPECT_EQ(state(), DriveState::kArmed);
  EXPECT_TRUE(noted("key released, commands stay armed"));

  QTest::mousePress(button("drive_hold"), Qt::LeftButton);
  EXPECT_EQ(state(), DriveState::kMoving);
  QTest::mouseRelease(button("drive_hold"), Qt::LeftButton);
  for (const char* theme : {"dark", "light"}) {
    window_->setThemeNamed(theme);
    QTest::qWait(60);
    test::grab(*window_->findChild<QDockWidget*>("registration"), QStringLiteral("drive_%1").arg(theme));
  }
  EXPECT_EQ(state(), DriveState::kArmed);

  nobodyNear()->setChecked(false);
  EXPECT_EQ(state(), DriveState::kDisarmed);
  EXPECT_TRUE(noted("commands disarmed"));
}

/// A window that hangs with the key down: the drive's own time ends the motion, and a new press is needed.
TEST_F(ShellDrive, AWindowThatHangsNeedsANewPress) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  QTest::qSleep(300);  // without events
  EXPECT_EQ(state(), DriveState::kArmed);
  QTest::qWait(200);
  EXPECT_EQ(state(), DriveState::kArmed) << "the key may have been released meanwhile";
  key(QEvent::KeyRelease, Qt::Key_F8);
  key(QEvent::KeyPress, Qt::Key_F8);
  EXPECT_EQ(state(), DriveState::kMoving);
  key(QEvent::KeyRelease, Qt::Key_F8);
}

TEST_F(ShellDrive, StopsByKeyFromAnywhere) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  window_->notes().line().setFocus();
  key(QEvent::KeyPress, Qt::Key_F9);
  ASSERT_NO_FATAL_FAILURE(expectStopped("stopped by hand"));
  key(QEvent::KeyPress, Qt::Key_F8, true);
  key(QEvent::KeyRelease, Qt::Key_F8);
  key(QEvent::KeyPress, Qt::Key_F8);
  EXPECT_EQ(state(), DriveState::kStopped) << "until it is armed again";
  key(QEvent::KeyRelease, Qt::Key_F8);
}

TEST_F(ShellDrive, StopsByItsButton) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  QTest::mousePress(button("drive_stop"), Qt::LeftButton);
  ASSERT_NO_FATAL_FAILURE(expectStopped("stopped by hand"));
}

TEST_F(ShellDrive, StopsWhereTheFocusIsLost) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  Q_EMIT qApp->applicationStateChanged(Qt::ApplicationInactive);
  ASSERT_NO_FATAL_FAILURE(expectStopped("the window has lost the focus"));
}

TEST_F(ShellDrive, StopsWhereAnotherWindowOpens) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  QWidget other;
  other.show();
  other.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&other));
  ASSERT_NO_FATAL_FAILURE(expectStopped("the window has lost the focus"));
}

TEST_F(ShellDrive, StopsWhereTheSessionIsPaused) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  window_->link().setRunning(false);
  ASSERT_TRUE(waitFor([&] { return state() == DriveState::kStopped; }));
  ASSERT_NO_FATAL_FAILURE(expectStopped("the session does not run"));
}

TEST_F(ShellDrive, StopsWhereThePanelIsClosed) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  window_->findChild<QDockWidget*>("registration")->close();
  EXPECT_TRUE(waitFor([&] { return state() == DriveState::kStopped; }));
}

TEST_F(ShellDrive, StopsWhereAnotherSourceIsOpened) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  window_->open(atRest());
  ASSERT_TRUE(waitFor([&] { return state() == DriveState::kStopped; }));
  EXPECT_TRUE(waitFor([&] { return !button("drive_stop")->isVisible(); }));
}

TEST_F(ShellDrive, StopsWithTheWindow) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(armAndHold());
  window_.reset();
  EXPECT_EQ(state(), DriveState::kStopped);
}

}  // namespace
}  // namespace capstan::widgets
