// What an operator meets in a real window: exchanged cameras, keys, the end of a session, old faults,
// replays, verdicts.
#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTextEdit>
#include <QToolButton>

#include "core/simulation/simulated_source.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/registration/collect_page.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/shell/export_controller.h"

namespace capstan::widgets {
namespace {

class Operator : public Shell {
 protected:
  std::unique_ptr<MainWindow> activeWindow() {
    auto window = makeWindow();
    QApplication::setActiveWindow(window.get());
    return window;
  }

  static QPushButton* button(const QWidget& panel, const QString& text) {
    for (auto* one : panel.findChildren<QPushButton*>())
      if (one->text() == text) return one;
    return nullptr;
  }
};

/// The left camera's images come as the right one's.
class ExchangedCameras final : public tracking::Source {
 public:
  explicit ExchangedCameras(const simulation::SimulationRequest& request)
      : source_(simulation::optionsOf(request)) {}
  const tracking::SourceInfo& info() const override { return source_.info(); }
  bool next(tracking::Sample& out) override {
    if (!source_.next(out)) return false;
    if (auto* frame = std::get_if<tracking::StereoFrame>(&out)) cv::swap(frame->left, frame->right);
    return true;
  }
  void block(bool left, bool right) override { source_.block(right, left); }

 private:
  simulation::SimulatedSource source_;
};

TEST_F(Operator, ExchangedCamerasAreNamedAsTheCause) {
  auto window = activeWindow();
  window->bar().setSpeed(5.0);
  simulation::SimulationRequest request;
  request.trajectory = "hard-stop";
  request.registered = false;
  window->link().take(std::make_unique<ExchangedCameras>(request));
  window->link().setRunning(true);
  window->action("register")->trigger();
  auto* panel = window->findChild<RegistrationPanel*>();
  auto* collect = button(*panel, "Collect frames");
  ASSERT_TRUE(waitFor([&] { return collect->isEnabled(); }));
  collect->click();
  ASSERT_TRUE(waitFor([&] { return panel->guide()->step() == registration::RegistrationStep::kRefused; }));
  const std::string said = panel->collectPage().refusal().toStdString();
  EXPECT_NE(said.find("exchanged"), std::string::npos) << said;
  EXPECT_NE(said.find("left"), std::string::npos) << said;
  EXPECT_EQ(said.find("Unblock the view"), std::string::npos) << said;
  test::grab(*panel, "operator_exchanged_cameras");
}

TEST_F(Operator, KeysBlockTheCamerasWhileTheRegistrationHasTheFocus) {
  auto window = activeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->action("register")->trigger();
  auto* panel = window->findChild<RegistrationPanel*>();
  auto* cancel = button(*panel, "Cancel");
  QApplication::setActiveWindow(cancel->window());
  cancel->setFocus();
  ASSERT_TRUE(waitFor([&] { return cancel->hasFocus(); }));
  for (const auto& [key, side] : {std::pair{Qt::Key_L, 0U}, std::pair{Qt::Key_K, 1U}}) {
    QTest::keyClick(cancel, key);
    EXPECT_TRUE(QTest::qWaitFor([&] { return window->link().runner()->status().blocked[side]; }, 2000))
        << "key " << static_cast<char>(key) << " is dead";
    QTest::keyClick(cancel, key);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !window->link().runner()->status().blocked[side]; }, 2000));
  }
}

TEST_F(Operator, KeysBlockTheCamerasWhateverHasTheFocusButText) {
  auto window = activeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  for (const char* page : {"", "analyse", "diagnose", "learn"}) {
    if (*page) window->action(page)->trigger();
    QTest::qWait(50);
    for (auto* widget : window->findChildren<QWidget*>()) {
      if (widget->window() != window.get() || !widget->isVisible() || !widget->isEnabled()) continue;
      if (!(widget->focusPolicy() & Qt::TabFocus) || widget->focusProxy()) continue;
      const auto* edit = qobject_cast<const QTextEdit*>(widget);
      const auto* plain = qobject_cast<const QPlainTextEdit*>(widget);
      if (qobject_cast<const QLineEdit*>(widget) || (edit && !edit->isReadOnly()) ||
          (plain && !plain->isReadOnly()))
        continue;
      widget->setFocus();
      QTest::keyClick(widget, Qt::Key_B);
      EXPECT_TRUE(QTest::qWaitFor([&] { return window->link().runner()->status().blocked[1]; }, 2000))
          << page << ": dead while " << widget->metaObject()->className() << " '"
          << widget->objectName().toStdString() << "' has the focus";
      if (!window->link().runner()->status().blocked[1]) continue;
      QTest::keyClick(widget, Qt::Key_B);
      ASSERT_TRUE(QTest::qWaitFor([&] { return !window->link().runner()->status().blocked[1]; }, 2000));
    }
    if (*page) window->action(page)->trigger();
  }
  window->notes().line().setFocus();
  QTest::keyClicks(&window->notes().line(), "blk");
  QTest::qWait(100);
  EXPECT_EQ(window->notes().line().text(), "blk");
  EXPECT_FALSE(window->link().runner()->status().blocked[0]);
  EXPECT_FALSE(window->link().runner()->status().blocked[1]);
}

TEST_F(Operator, AtTheEndTheRegistrationSaysWhyItCannotDrive) {
  auto window = activeWindow();
  window->bar().setSpeed(10.0);
  SourceChoice choice = atRest(1.0);
  choice.simulation.registered = false;
  window->open(choice);
  ASSERT_TRUE(waitFor([&] { return window->link().ended(); }));
  window->action("register")->trigger();
  auto* panel = window->findChild<RegistrationPanel*>();
  auto* drive = button(*panel, "Drive to the hard stop");
  ASSERT_TRUE(drive);
  EXPECT_TRUE(waitFor([&] { return !drive->isEnabled(); })) << "it does nothing at a session's end";
  bool said = false;
  for (auto* label : panel->findChildren<QLabel*>())
    said = said || (label->isVisible() && label->text().contains("has ended"));
  EXPECT_TRUE(said) << "no reason is shown";
  test::grab(*panel, "operator_registration_at_the_end");

  window->action("run")->trigger();  // again
  ASSERT_TRUE(waitFor([&] { return drive->isEnabled(); }));
  for (auto* label : panel->findChildren<QLabel*>())
    EXPECT_FALSE(label->isVisible() && label->text().contains("has ended"));
}

TEST_F(Operator, AnOldFaultGoesWhenAFileOpens) {
  const QString recording = file("trial.capstan");
  commandLine({"simulate", "--out", recording, "--duration", "1", "--no-images"});
  auto window = activeWindow();
  window->open(SourceChoice::ofFile(file("gone.capstan")));
  ASSERT_TRUE(waitFor([&] { return !window->message().isEmpty(); }));
  window->open(SourceChoice::ofFile(recording));
  ASSERT_TRUE(waitFor([&] { return window->link().runner() != nullptr; }));
  EXPECT_TRUE(waitFor([&] { return stateOf(*window) != live::RunState::kPaused; }));
  EXPECT_TRUE(window->message().isEmpty()) << window->message().toStdString();
}

TEST_F(Operator, AFaultOfAnExportGoesWithTheNextThatSucceeds) {
  auto window = activeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  ASSERT_TRUE(waitFor([&] { return window->figure().history().end() > 0.5; }));
  window->exports().exportPlots("/proc/nowhere/plots");
  ASSERT_FALSE(window->message().isEmpty());
  window->exports().exportPlots(file("plots"));
  EXPECT_TRUE(window->message().isEmpty()) << window->message().toStdString();
}

TEST_F(Operator, AReplayIsCalledARecordingByItsFile) {
  const QString recording = file("monday.capstan");
  commandLine({"simulate", "--out", recording, "--duration", "2", "--no-images"});
  auto window = activeWindow();
  window->open(SourceChoice::ofFile(recording));
  ASSERT_TRUE(waitFor([&] { return window->windowTitle().contains("RAVEN") || window->link().ended(); }));
  auto* line = window->findChild<StatusLine*>();
  for (const QString& words : {window->windowTitle(), line->text(), window->notes().row(0)}) {
    EXPECT_TRUE(words.contains("recording")) << words.toStdString();
    EXPECT_TRUE(words.contains("monday.capstan")) << words.toStdString();
  }
  window->open(atRest());
  ASSERT_TRUE(waitFor([&] {
    const QString title = window->windowTitle();
    return title.contains("simulated") && !title.contains("monday.capstan");
  }));
  EXPECT_FALSE(window->windowTitle().contains("recording")) << window->windowTitle().toStdString();
  ASSERT_TRUE(waitFor([&] { return !line->text().contains("monday.capstan"); }));
}

TEST_F(Operator, AWrongRobotIsSaidAndIdentifyIsBesideIt) {
  auto window = activeWindow();
  window->bar().setSpeed(10.0);
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.images = false;
  window->open(SourceChoice::ofSimulation(request));
  ASSERT_TRUE(opened(*window));
  auto* line = window->findChild<StatusLine*>();
  ASSERT_TRUE(waitFor([&] { return line->text().contains("q1 travel"); })) << line->text().toStdString();
  auto* remedies = line->findChild<QToolButton*>("remedies");
  ASSERT_TRUE(remedies);
  EXPECT_TRUE(remedies->isVisible());
  ASSERT_TRUE(remedies->menu());
  EXPECT_TRUE(remedies->menu()->actions().contains(window->action("identify")));
  EXPECT_TRUE(remedies->menu()->actions().contains(window->action("diagnose")));
  test::grab(*window, "operator_too_high");
}

}  // namespace
}  // namespace capstan::widgets
