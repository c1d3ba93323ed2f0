// Stereo monitors of the window's sessions: what is started, and what they get.
#include <QAction>
#include <QFile>

#include "core/base/error.h"
#include "core/live/feed/feed_clock.h"
#include "core/live/feed/feed_reader.h"
#include "core/live/feed/feed_writer.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/shell/monitor_controller.h"

namespace capstan::widgets {
namespace {

/// Newest state of a feed; reads until `condition`.
bool readUntil(live::FeedReader& reader, live::FeedFrame& frame, const std::function<bool()>& condition) {
  return waitFor([&] {
    reader.read(frame, live::feedNow());
    return condition();
  });
}

TEST_F(Shell, StartsAMonitorWithTheFeedOfItsSession) {
  QFile program(file("monitor.sh"));
  ASSERT_TRUE(program.open(QIODevice::WriteOnly));
  program.write("#!/bin/sh\necho \"$@\" >" + file("arguments.txt").toUtf8() + ".part\nmv " +
                file("arguments.txt").toUtf8() + ".part " + file("arguments.txt").toUtf8() + "\n");
  program.close();
  program.setPermissions(QFile::ReadOwner | QFile::ExeOwner);

  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  EXPECT_TRUE(window->monitor().feed().isEmpty()) << "no feed before the first monitor";
  window->monitor().setProgram(program.fileName());
  window->findChild<QAction*>("monitor")->trigger();
  ASSERT_TRUE(waitFor([&] { return QFile::exists(file("arguments.txt")); }));
  QFile arguments(file("arguments.txt"));
  ASSERT_TRUE(arguments.open(QIODevice::ReadOnly));
  EXPECT_EQ(arguments.readAll(), QByteArray("--feed ") + window->monitor().feed().toUtf8() + "\n");

  live::FeedReader reader(window->monitor().feed().toStdString());
  live::FeedFrame frame;
  ASSERT_TRUE(readUntil(reader, frame, [&] { return frame.state.number > 3 && !frame.images[0].empty(); }));
  EXPECT_EQ(live::textOf(frame.state.title), window->link().runner()->info().title);
  window->link().setRunning(false);
  EXPECT_TRUE(readUntil(reader, frame, [&] { return reader.run() == live::FeedRun::kPaused; }));
}

TEST_F(Shell, FeedsMonitorsFromTheNextSessionToo) {
  auto window = makeWindow();
  const QString name = QStringLiteral("shell-%1").arg(QCoreApplication::applicationPid());
  window->monitor().startFeed(name);
  EXPECT_EQ(window->monitor().feed(), name);
  live::FeedReader reader(name.toStdString());
  live::FeedFrame frame;
  for (const std::uint64_t session : {1U, 2U}) {
    window->open(atRest());
    ASSERT_TRUE(readUntil(reader, frame, [&] { return frame.state.session == session; })) << session;
  }
  window.reset();
  reader.read(frame, live::feedNow());
  EXPECT_EQ(reader.link(), live::FeedReader::Link::kEnded);
}

TEST_F(Shell, AMonitorThatIsMissingIsNamed) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->monitor().setProgram(file("nowhere/capstan-monitor"));
  window->findChild<QAction*>("monitor")->trigger();
  EXPECT_TRUE(window->message().contains("capstan-monitor --feed " + window->monitor().feed()))
      << window->message().toStdString();
}

TEST_F(Shell, AFeedOfAnotherSessionIsRefused) {
  const std::string name = "taken-" + std::to_string(QCoreApplication::applicationPid());
  const live::FeedWriter other(name);
  auto window = makeWindow();
  EXPECT_THROW(window->monitor().startFeed(QString::fromStdString(name)), base::InputError);
}

}  // namespace
}  // namespace capstan::widgets
