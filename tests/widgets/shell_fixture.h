#pragma once

#include <gtest/gtest.h>

#include <QProcess>
#include <QTemporaryDir>
#include <QtTest/QTest>

#include "tests/support/folders.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"

namespace capstan::widgets {

inline constexpr int kPatience = 30000;  // [ms] after which a wait has failed

template <class Condition>
bool waitFor(Condition&& condition) {
  return QTest::qWaitFor(condition, kPatience);
}

inline QByteArray commandLine(const QStringList& arguments) {
  QProcess process;
  process.start(QString::fromStdString(capstan::test::commandLineProgram()), arguments);
  EXPECT_TRUE(process.waitForFinished(60000));
  EXPECT_EQ(process.exitCode(), 0) << process.readAllStandardError().toStdString();
  return process.readAllStandardOutput();
}

class Shell : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(folder_.isValid()); }

  QString file(const QString& name) const { return folder_.filePath(name); }

  std::unique_ptr<MainWindow> makeWindow() {
    auto window = std::make_unique<MainWindow>(file("settings.ini"));
    window->bar().setRecordingFolder(file("recordings"));
    window->resize(1280, 800);
    window->show();
    window->activateWindow();
    return window;
  }

  /// At rest, without cameras' pictures being of interest: quick to open.
  static SourceChoice atRest(double duration = 600.0) {
    simulation::SimulationRequest request;
    request.trajectory = "hold";
    request.duration = duration;
    return SourceChoice::ofSimulation(request);
  }

  static live::RunState stateOf(MainWindow& window) {
    return window.link().runner() ? window.link().runner()->status().state : live::RunState::kFailed;
  }
  static bool opened(MainWindow& window) {
    return waitFor([&] { return stateOf(window) == live::RunState::kRunning; });
  }

  QTemporaryDir folder_;
};

inline QString statusOf(MainWindow& window) { return window.findChild<StatusLine*>()->text(); }

}  // namespace capstan::widgets
