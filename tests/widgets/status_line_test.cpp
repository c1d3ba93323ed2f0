// What the status line says, word by word.
#include "widgets/panels/status/status_line.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QCoreApplication>
#include <QHelpEvent>
#include <QLabel>
#include <QTemporaryDir>
#include <QToolButton>

#include "tests/widgets/picture.h"

namespace capstan::widgets {
namespace {

tracking::Snapshot calm() {
  tracking::Snapshot snapshot;
  snapshot.camera_samples = 10;
  snapshot.camera_images = true;
  snapshot.gate = tracking::Gate::kOpen;
  snapshot.latency = 0.042;
  return snapshot;
}

using tracking::HealthVerdict;

std::vector<tracking::HealthCheck> health(const std::string& value, HealthVerdict verdict) {
  return {{"nis_q1", "NIS of shoulder", HealthVerdict::kPass, "1.00"},
          {"nis_q2", "NIS of elbow", verdict, value},
          {"lost", "lost samples", HealthVerdict::kFail, "12"}};
}

live::RunStatus running() {
  live::RunStatus status;
  status.state = live::RunState::kRunning;
  status.motor_rate = 1000.0;
  status.frame_rate = 15.0;
  status.speed = 1.0;
  status.real_time_factor = 1.0;
  return status;
}

TEST(StatusLine, ALongReasonLeavesRoomForTheOtherParts) {
  StatusLine line;
  live::RunStatus status = running();
  tracking::SideStatus cameras;
  cameras.name = "cameras", cameras.counted = "image";
  cameras.state = tracking::SideStatus::State::kSilent;
  cameras.reason =
      "http://192.168.100.100:8080/stream/of/the/left/camera: no server answers there. Start the camera's "
      "server, or correct the address";
  status.sides = {cameras};
  status.recorder = recording::RecorderStats();
  line.resize(900, 24);
  line.showSnapshot(calm());
  line.showHealth(health("1.02", HealthVerdict::kPass));
  line.showStatus(status, 65.0);
  line.show();
  test::leave(line.grab().toImage(), "status_line_long_reason");
  int right = 0;
  for (const auto* label : line.findChildren<QLabel*>())
    if (label->isVisible()) right = std::max(right, label->geometry().right());
  EXPECT_LE(right, line.width());
  QHelpEvent asked(QEvent::ToolTip, QPoint(1, 1), QPoint(1, 1));
  QCoreApplication::sendEvent(&line, &asked);
  EXPECT_TRUE(line.toolTip().contains(QString::fromStdString(cameras.reason))) << "the whole text";
  EXPECT_TRUE(line.toolTip().contains("0 images, 0 missing")) << "and the numbers";
  for (const auto* label : line.findChildren<QLabel*>())
    if (label->text().startsWith("NIS")) {
      EXPECT_GE(label->width(), label->sizeHint().width());
    }
}

TEST(StatusLine, WhatNeedsAttentionComesFirstAndOnOneLine) {
  StatusLine line;
  live::RunStatus status = running();
  tracking::SideStatus motors, cameras;
  motors.name = "motors", motors.from = "tcp://127.0.0.1:5555";
  cameras.name = "cameras", cameras.state = tracking::SideStatus::State::kRefused;
  cameras.fault = "first line\nsecond line";
  status.sides = {motors, cameras};
  status.real_time_factor = 0.0;
  line.showSnapshot(calm());
  line.showStatus(status, 0.0);
  EXPECT_TRUE(line.text().contains(
      "cameras refused: first line second line, motors: waiting at tcp://127.0.0.1:5555"))
      << line.text().toStdString();
  EXPECT_FALSE(line.text().contains("only")) << "a live session has no speed";
}

TEST(StatusLine, ReadsAsOneLine) {
  StatusLine line;
  line.showSnapshot(calm());
  line.showHealth(health("1.02", HealthVerdict::kPass));
  line.showStatus(running(), 0.0);
  EXPECT_EQ(line.text(), QString::fromUtf8("running · 1000 Hz · 15.0 fps · lag  42 ms · gate open · "
                                           "NIS of shoulder 1.00 pass · rescues 0"));
  test::grab(line, "status_line");
}

TEST(StatusLine, ALiveSessionIsCalledLive) {
  StatusLine line;
  live::RunStatus status = running();
  tracking::SideStatus cameras;
  cameras.name = "cameras", cameras.state = tracking::SideStatus::State::kReceiving;
  status.sides = {cameras};
  line.showStatus(status, 0.0);
  EXPECT_TRUE(line.text().startsWith(QString::fromUtf8("live · 1000 Hz"))) << line.text().toStdString();
  status.sides[0].state = tracking::SideStatus::State::kSilent;
  status.sides[0].part = "right", status.sides[0].silent_for = 3.04;
  status.sides[0].reason = "no server answers there";
  line.showStatus(status, 0.0);
  EXPECT_TRUE(line.text().contains("right camera silent for 3.0 s: no server answers there"))
      << line.text().toStdString();
}

TEST(StatusLine, NamesMotorsWhoseEncoderFailed) {
  StatusLine line;
  auto snapshot = calm();
  snapshot.motor_failed = {tracking::MotorFault::kNone, tracking::MotorFault::kFrozen,
                           tracking::MotorFault::kDeclared};
  line.showSnapshot(snapshot);
  EXPECT_TRUE(line.text().contains("motor 2 frozen, motor 3 failed")) << line.text().toStdString();
  line.showSnapshot(calm());
  EXPECT_FALSE(line.text().contains("motor"));
}

TEST(StatusLine, SaysWhatIsWrong) {
  StatusLine line;
  auto snapshot = calm();
  snapshot.gate = tracking::Gate::kLeftLost;
  snapshot.rescues = 3;
  snapshot.motor_refused = 12;
  line.showSnapshot(snapshot);
  line.showHealth(health("8.20", HealthVerdict::kFail));
  auto status = running();
  status.real_time_factor = 0.4;
  line.showStatus(status, 0.0);
  for (const char* words : {"gate shut: left lost", "NIS of elbow 8.20 FAIL", "rescues 3",
                            "12 motor samples refused", "only ×0.4"})
    EXPECT_TRUE(line.text().contains(QString::fromUtf8(words)))
        << words << " in " << line.text().toStdString();
}

TEST(StatusLine, NamesTheRobotInUseAndOcclusion) {
  StatusLine line;
  line.setRobot("RAVEN-II left, identified", "r_l1 59.02 mm");
  auto status = running();
  status.blocked = {true, false};
  line.showStatus(status, 0.0);
  EXPECT_TRUE(line.text().startsWith(QString::fromUtf8("running · robot RAVEN-II left, identified")));
  EXPECT_TRUE(line.text().contains("left blocked")) << line.text().toStdString();
  status.occlusion.percentage = 40.0;
  status.occlusion_added = true;
  line.showStatus(status, 0.0);
  EXPECT_TRUE(line.text().contains("occlusion 40 %, added to the recording")) << line.text().toStdString();
  line.showStatus(running(), 0.0);
  EXPECT_FALSE(line.text().contains("occlusion"));
}

TEST(StatusLine, NisIsThatOfTheEstimatorsHealth) {
  StatusLine line;
  auto snapshot = calm();
  snapshot.nis_mean = 0.56;  // below its narrow 95 % band, which does not judge here
  snapshot.nis_consistent = false;
  line.showSnapshot(snapshot);
  EXPECT_FALSE(line.text().contains("NIS")) << line.text().toStdString();
  line.showHealth(health("0.13", HealthVerdict::kCautious));
  EXPECT_TRUE(line.text().contains("NIS of elbow 0.13 cautious")) << line.text().toStdString();
  for (auto* label : line.findChildren<QLabel*>())
    if (label->text().contains("NIS")) {
      EXPECT_EQ(label->palette().color(QPalette::WindowText), Theme::dark().text);
      EXPECT_FALSE(label->font().bold());
      EXPECT_TRUE(label->toolTip().contains("NIS of shoulder 1.00 pass")) << label->toolTip().toStdString();
    }
  line.showHealth({{"nis_q1", "NIS of shoulder", HealthVerdict::kUnknown, "0.11"}});
  EXPECT_TRUE(line.text().contains("NIS not judged yet")) << line.text().toStdString();
  line.showHealth({{"nis_q1", "NIS of shoulder", HealthVerdict::kUnknown, ""}});
  EXPECT_FALSE(line.text().contains("NIS")) << "a robot without cameras: " << line.text().toStdString();
}

TEST(StatusLine, OffersTheRemediesOnlyWhileTheVerdictFails) {
  StatusLine line;
  QAction identify("Identify");
  line.setRemedies({&identify});
  auto* button = line.findChild<QToolButton*>("remedies");
  line.showSnapshot(calm());
  for (const auto verdict : {HealthVerdict::kFail, HealthVerdict::kPass, HealthVerdict::kCautious}) {
    line.showHealth(health("8.20", verdict));
    EXPECT_EQ(!button->isHidden(), verdict == HealthVerdict::kFail) << base::nameOf(verdict);
  }
}

TEST(StatusLine, InANarrowWindowWhatIsWrongStaysSeen) {
  StatusLine line;
  auto snapshot = calm();
  snapshot.gate = tracking::Gate::kLeftLost;
  line.setSource("recording a_rather_long_name_of_a_file.capstan");
  line.showSnapshot(snapshot);
  line.showHealth(health("8.20", HealthVerdict::kFail));
  line.showStatus(running(), 0.0);
  line.resize(500, 28);
  line.show();
  const auto seen = [&](const char* words) {
    for (auto* label : line.findChildren<QLabel*>())
      if (label->isVisible() && label->text().contains(words)) return true;
    return false;
  };
  EXPECT_TRUE(seen("gate shut: left lost"));
  EXPECT_TRUE(seen("8.20 FAIL"));
  EXPECT_FALSE(seen("1000 Hz"));
  QHelpEvent asked(QEvent::ToolTip, QPoint(1, 1), QPoint(1, 1));
  QCoreApplication::sendEvent(&line, &asked);
  EXPECT_TRUE(line.toolTip().contains("1000 Hz"));
  live::RunStatus slower = running();
  slower.motor_rate = 500.0;
  line.showStatus(slower, 0.0);
  QCoreApplication::sendEvent(&line, &asked);
  EXPECT_TRUE(line.toolTip().contains("500 Hz")) << "the text of now";
  line.showStatus(running(), 0.0);
  line.resize(2000, 28);
  EXPECT_TRUE(seen("1000 Hz"));
}

TEST(StatusLine, FollowsTheRecording) {
  StatusLine line;
  auto status = running();
  status.recorder.emplace();
  status.recorder->free_known = true;
  status.recorder->free_bytes = 312'000'000'000;
  status.recorder->reserve_bytes = 268'435'456;
  status.recorder->time_left = 22'080.0;
  line.showStatus(status, 192.7);
  EXPECT_TRUE(line.text().contains(QString::fromUtf8("● REC 03:12"))) << line.text().toStdString();
  EXPECT_TRUE(line.text().contains("disk 312 GB, reserve 268 MB, 368 min left")) << line.text().toStdString();
  status.recorder->time_left = 30.0;
  line.showStatus(status, 192.7);
  EXPECT_TRUE(line.text().contains("under 1 min left")) << line.text().toStdString();
  status.recorder->dropped = 7;
  line.showStatus(status, 192.7);
  EXPECT_TRUE(line.text().contains("7 dropped"));
  status.recorder->state = recording::RecorderState::kFailed;
  line.showStatus(status, 192.7);
  EXPECT_TRUE(line.text().contains("recording failed"));
}

TEST(StatusLine, SpeaksOfTipsWhereThereAreNoPictures) {
  StatusLine line;
  auto snapshot = calm();
  snapshot.camera_images = false;
  line.showSnapshot(snapshot);
  line.showStatus(running(), 0.0);
  EXPECT_TRUE(line.text().contains("15.0 tips/s")) << line.text().toStdString();
  EXPECT_FALSE(line.text().contains("fps"));
  snapshot.gate = tracking::Gate::kBothLost;
  line.showSnapshot(snapshot);
  EXPECT_TRUE(line.text().contains("gate shut: tip not seen")) << line.text().toStdString();
}

TEST(StatusLine, TellsWhereTheRecordingGoes) {
  StatusLine line;
  line.setFolder("/data/arm");
  auto status = running();
  status.recorder.emplace().free_known = true;
  status.recording = "/data/arm/one.capstan";
  line.showStatus(status, 1.0);
  QStringList tips;
  for (const auto* label : line.findChildren<QLabel*>())
    if (!label->text().isEmpty()) tips << label->toolTip();
  EXPECT_TRUE(tips.contains("/data/arm/one.capstan")) << tips.join("; ").toStdString();
  EXPECT_EQ(tips.filter("/data/arm").size(), 2) << "recording and disk";
}

TEST(StatusLine, KnowsTheDiskOfAFolderThatIsNotThereYet) {
  const QTemporaryDir folder;
  StatusLine line;
  line.setFolder(folder.filePath("not/yet/there"));
  line.showStatus(running(), 0.0);
  EXPECT_TRUE(line.text().contains("GB")) << line.text().toStdString();
}

TEST(StatusLine, TakesARelativeFolder) {
  StatusLine line;
  line.setFolder("recordings/of/today");
  line.showStatus(running(), 0.0);
  EXPECT_TRUE(line.text().contains("GB")) << line.text().toStdString();
}

TEST(StatusLine, ClockText) {
  EXPECT_EQ(clockText(0.0), "00:00");
  EXPECT_EQ(clockText(192.7), "03:12");
  EXPECT_EQ(clockText(3723.0), "1:02:03");
  EXPECT_EQ(clockText(-1.0), "00:00");
}

}  // namespace
}  // namespace capstan::widgets
