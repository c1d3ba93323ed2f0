// Recording onto real small disks in a real window: full ones, read-only ones, and what the status line says.
#include <QAction>
#include <QFileDialog>
#include <fstream>

#include "core/recording/disk_space.h"
#include "core/recording/session_source.h"
#include "tests/support/small_disk.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/status/status_line.h"

namespace capstan::widgets {
namespace {

QString pathOf(const SmallDisk& disk) { return QString::fromStdString(disk.path().string()); }

/// Through the menu and its dialog.
void chooseFolder(MainWindow& window, const QString& folder) {
  for (auto* action : window.findChildren<QAction*>())
    if (action->text().startsWith("Recording folder")) action->trigger();
  auto* dialog = window.findChild<QFileDialog*>();
  ASSERT_TRUE(dialog);
  Q_EMIT dialog->fileSelected(folder);
  dialog->close();
}

double endOf(const std::filesystem::path& file) {
  recording::SessionSource source(file);
  double end = -1.0;
  for (tracking::Sample sample; source.next(sample);)
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) end = motor->t;
  return end;
}

TEST_F(Shell, ARecordingOntoAFullDiskIsWholeInItsOneFile) {
  const SmallDisk disk(64);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const auto window = makeWindow();
  chooseFolder(*window, pathOf(disk));
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return window->link().recording(); })) << window->message().toStdString();
  QString told;
  double end = 0.0;
  ASSERT_TRUE(waitFor([&] {
    const auto status = window->link().runner()->status();
    if (statusOf(*window).contains("min left")) told = statusOf(*window);
    if (status.recorder->state != recording::RecorderState::kFailed) end = status.t;
    return status.recorder->state == recording::RecorderState::kFailed;
  })) << "the disk was never full";
  EXPECT_TRUE(told.contains("reserve 6.7 MB")) << told.toStdString();
  const auto status = window->link().runner()->status();
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk.path()), {}), 1) << "the one file";
  const auto copy = file("copy.capstan").toStdString();
  std::filesystem::copy_file(status.recording, copy);
  EXPECT_GT(recording::readSessionSummary(copy).motor, 1000);
  EXPECT_LE(end - endOf(copy), 0.5) << "lost";
  std::printf("running to %.3f s, in the copy to %.3f s; %s\n%s\n", end, endOf(copy),
              status.recorder->error.c_str(), told.toStdString().c_str());
  ASSERT_TRUE(waitFor([&] { return window->message().contains("intact"); }));
  EXPECT_TRUE(window->message().contains("Free space")) << window->message().toStdString();
  EXPECT_EQ(stateOf(*window), live::RunState::kRunning) << "the session goes on";
}

// The source changes while it is recorded, onto a disk that is full by then: somebody has to hear of it.
TEST_F(Shell, TheFaultOfARecordingIsToldAfterItsSessionIsGone) {
  const SmallDisk disk(64);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const auto window = makeWindow();
  chooseFolder(*window, pathOf(disk));
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return window->link().recording(); })) << window->message().toStdString();
  std::ofstream(disk / "other", std::ios::binary) << std::string(disk.freeBytes(), 'x') << std::flush;
  auto* const before = window->link().runner();
  window->open(atRest());
  ASSERT_TRUE(waitFor([&] { return window->link().runner() != before && !window->link().opening(); }));
  ASSERT_TRUE(waitFor([&] { return window->message().contains("recording"); })) << "nobody heard of it";
  EXPECT_TRUE(window->message().contains(".capstan")) << window->message().toStdString();
  const auto* notes = window->findChild<NotesPanel*>();
  for (int i = 0; i < notes->rows(); ++i)
    EXPECT_FALSE(notes->row(i).contains("stopped")) << notes->row(i).toStdString();
}

TEST_F(Shell, AReadOnlyFolderIsRefusedWhenChosen) {
  const SmallDisk disk(1);
  if (!disk.mounted() || !disk.makeReadOnly()) GTEST_SKIP() << disk.why();
  const auto window = makeWindow();
  const QString before = window->bar().recordingFolder();
  chooseFolder(*window, pathOf(disk));
  EXPECT_TRUE(window->message().contains(pathOf(disk) + ": cannot be written: Read-only"))
      << window->message().toStdString();
  EXPECT_EQ(window->bar().recordingFolder(), before);
}

TEST_F(Shell, AFullFolderIsRefusedWhenChosenAndWhenRecordedTo) {
  const SmallDisk disk(16);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const auto window = makeWindow();
  chooseFolder(*window, pathOf(disk));
  EXPECT_EQ(window->bar().recordingFolder(), pathOf(disk));
  std::ofstream(disk / "other", std::ios::binary) << std::string(disk.freeBytes() - (1U << 20), 'x');
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->action("record")->trigger();
  EXPECT_TRUE(window->message().contains("only the reserve of 1.7 MB is free"))
      << window->message().toStdString();
  EXPECT_FALSE(window->link().recording());
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk.path()), {}), 1) << "nothing was begun";
}

TEST_F(Shell, TheDiskIsThatOfTheFolderChosenLast) {
  const SmallDisk disk(48);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(waitFor([&] { return statusOf(*window).contains("disk"); }));
  chooseFolder(*window, pathOf(disk));
  const QString expected = QStringLiteral("disk 50 MB, reserve 5.0 MB");
  EXPECT_TRUE(QTest::qWaitFor([&] { return statusOf(*window).contains(expected); }, 3000))
      << statusOf(*window).toStdString();
}

}  // namespace
}  // namespace capstan::widgets
