// window_study [--seconds 60] [--cycles 50] [--session FILE] [--points 1000000]: the window at full load in a
// real display: 2 × 30 frames per second, 1 kHz motors, recording, the scene, plots with as many points a
// curve. Frame rate, time between frames, input to paint, samples lost, time by thread; then the memory over
// cycles of opening a recording and closing it, and over running.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTimer>
#include <QWheelEvent>
#include <QtTest/QTest>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/base/large_blocks.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/quantile.h"
#include "tests/support/folders.h"
#include "tests/support/process_use.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"
#include "widgets/video/stereo_view.h"

namespace {

using namespace capstan;
using namespace capstan::widgets;
using test::allocatedMegabytes;
using test::residentMegabytes;

/// Notes when the cameras' view has been painted, and how long after an input the figure was.
class Watch : public QApplication {
 public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override {
    const QEvent::Type type = event->type();
    const bool painted = type == QEvent::Paint;
    const char* name = receiver->metaObject()->className();
    const double children = inside;
    inside = 0.0;
    const auto begin = clock.nsecsElapsed();
    const bool done = QApplication::notify(receiver, event);
    const double spent = 1e-9 * static_cast<double>(clock.nsecsElapsed() - begin);
    if (counting)
      busy[std::string(name) + (painted                 ? ", paint"
                                : type == QEvent::Timer ? ", timer"
                                                        : ", other")] += spent - inside;
    inside = children + spent;
    if (painted && receiver == figure && input >= 0) {
      input_to_paint.push_back(1e-6 * static_cast<double>(clock.nsecsElapsed() - input));
      input = -1;
    }
    if (painted && video && (receiver == video || video->isAncestorOf(qobject_cast<QWidget*>(receiver)))) {
      const auto now = clock.nsecsElapsed();
      if (counting && last >= 0 && now - last > 2'000'000)
        intervals.push_back(1e-6 * static_cast<double>(now - last));
      if (last < 0 || now - last > 2'000'000) last = now;  // both eyes are painted one after the other
    }
    return done;
  }

  QWidget* figure = nullptr;
  QWidget* video = nullptr;
  QElapsedTimer clock;
  qint64 input = -1, last = -1;
  bool counting = false;
  double inside = 0.0;                            ///< of events within the present one [s]
  std::map<std::string, double> busy;             ///< of the window's thread, by receiver and event [s]
  std::vector<double> intervals, input_to_paint;  // [ms]
};

/// Processor time of every thread of this process, by its name [s].
std::map<std::string, double> threadTimes() {
  std::map<std::string, double> times;
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream file(task.path() / "stat");
    std::string line;
    std::getline(file, line);
    const auto open = line.find('('), close = line.rfind(')');
    if (close == std::string::npos) continue;
    std::istringstream rest(line.substr(close + 2));
    std::string word;
    double user = 0.0, system = 0.0;
    for (int i = 0; i < 11; ++i) rest >> word;
    rest >> user >> system;
    const bool main = task.path().filename() == std::to_string(::getpid());
    times[main ? "window" : line.substr(open + 1, close - open - 1)] +=
        (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }
  return times;
}

simulation::SimulatedOptions session(double seconds, double rate) {
  simulation::SimulationRequest request;
  request.duration = seconds;
  simulation::SimulatedOptions options = simulation::optionsOf(request);
  options.truth.cameras.rate = rate;
  options.truth.cameras.latency_jitter =
      0.0;  // regular cameras: what is measured is the window's irregularity
  return options;
}

/// Rows of a long session before time 0, 200 per second, as the session itself sends them.
void fillPlots(MainWindow& window, int points) {
  std::vector<tracking::Snapshot> some;
  window.link().runner()->drainHistory(some);
  tracking::Snapshot snapshot;
  window.link().runner()->takeSnapshot(snapshot);
  snapshot.camera_updated = false;
  snapshot.motor_updated = snapshot.reference_paired = true;
  std::vector<tracking::Snapshot> chunk;
  for (int i = -points; i < 0; ++i) {
    snapshot.t = i / 200.0;
    const double wave = 0.2 * std::sin(0.5 * snapshot.t) + 0.01 * std::sin(37.0 * snapshot.t);
    for (auto* joint : {&snapshot.q_link_true, &snapshot.q_link_kin, &snapshot.q_link_ukf})
      *joint = Eigen::Vector3d(0.6 + wave, 1.5 + wave, 0.4 + 0.1 * wave);
    chunk.push_back(snapshot);
    if (chunk.size() < 20000 && i != -1) continue;
    Q_EMIT window.link().history(chunk);
    chunk.clear();
  }
}

void load(Watch& app, const QString& folder, double seconds, int points) {
  MainWindow window(folder + "/settings.ini");
  window.bar().setRecordingFolder(folder + "/recordings");
  window.resize(1280, 800);
  window.show();
  window.link().take(std::make_unique<simulation::SimulatedSource>(session(seconds + 60.0, 30.0)));
  window.figure().setFollowing(true);
  QTest::qWait(200);
  if (!window.link().runner()) return void(std::printf("no session\n"));
  fillPlots(window, points);
  window.link().setRunning(true);
  window.link().toggleRecording(window.bar().recordingFolder());
  QTest::qWait(3000);
  window.figure().setSpan(window.figure().history().end() - window.figure().history().begin());
  QTest::qWait(1000);

  app.figure = &window.figure();
  app.video = window.findChild<StereoView*>();
  app.counting = true;
  const auto before = threadTimes();
  QElapsedTimer spent;
  spent.start();
  const double from = window.link().runner()->status().t;
  QTest::qWait(static_cast<int>(500.0 * seconds));
  const std::vector<double> alone = app.intervals;
  while (1e-3 * static_cast<double>(spent.elapsed()) < seconds) {
    QTest::qWait(450);
    const QPointF place = window.figure().rect().center();
    app.input = app.clock.nsecsElapsed();
    QApplication::postEvent(&window.figure(),
                            new QWheelEvent(place, window.figure().mapToGlobal(place.toPoint()), {}, {0, 120},
                                            Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false));
    QTest::qWait(50);
    window.figure().setSpan(window.figure().history().end() - window.figure().history().begin());
  }
  app.counting = false;
  const double wall = 1e-3 * static_cast<double>(spent.elapsed());
  const live::RunStatus status = window.link().runner()->status();
  const auto after = threadTimes();
  const auto quantile = [](std::vector<double> values, double share) {
    return stats::quantile(values, share);
  };
  std::printf("full load for %.0f s, %d points a curve:\n", wall, points);
  const std::vector<double> zoomed(app.intervals.begin() + static_cast<std::ptrdiff_t>(alone.size()),
                                   app.intervals.end());
  std::printf("  frames of the cameras' view   %6.1f per second       (target: at least 25)\n",
              static_cast<double>(app.intervals.size()) / wall);
  std::printf("  between frames, 99 %%          %6.1f ms, median %.1f ms  (target: at most 50 ms)\n",
              quantile(alone, 0.99), quantile(alone, 0.5));
  std::printf(
      "    while the plots are zoomed  %6.1f ms, median %.1f ms  (four zooms over all points per second)\n",
      quantile(zoomed, 0.99), quantile(zoomed, 0.5));
  std::printf(
      "  input to paint, 99 %%          %6.1f ms, median %.1f ms  (target: at most 100 ms; %zu inputs)\n",
      quantile(app.input_to_paint, 0.99), quantile(app.input_to_paint, 0.5), app.input_to_paint.size());
  std::printf("  session time over wall time   %6.3f                 (1: nothing waits)\n",
              (status.t - from) / wall);
  if (status.recorder)
    std::printf("  recorded rows                 %llu of %llu, %llu dropped  (target: 0 dropped)\n",
                static_cast<unsigned long long>(status.recorder->written),
                static_cast<unsigned long long>(status.recorder->queued),
                static_cast<unsigned long long>(status.recorder->dropped));
  std::printf("  processor time by thread, share of one core:\n");
  for (const auto& [name, time] : after) {
    const auto was = before.find(name);
    const double used = (time - (was == before.end() ? 0.0 : was->second)) / wall;
    if (used > 0.002) std::printf("    %-20s %5.1f %%\n", name.c_str(), 100.0 * used);
  }
  std::printf("  time of the window's thread, share of one core:\n");
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, time] : app.busy) order.emplace_back(time / wall, name);
  std::sort(order.rbegin(), order.rend());
  for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 10); ++i)
    std::printf("    %-44s %5.1f %%\n", order[i].second.c_str(), 100.0 * order[i].first);
  app.figure = app.video = nullptr;
  window.link().runner()->stopRecording();
  window.close();
}

/// Opens the recording, waits until it has been tracked to its end or for `most` seconds, and closes it.
bool cycle(MainWindow& window, const QString& file, int most) {
  bool opened = false;
  const auto heard = QObject::connect(&window.link(), &SessionLink::opened, [&] { opened = true; });
  window.open(SourceChoice::ofFile(file));  // closes the one before, in the background
  const bool played =
      QTest::qWaitFor([&] { return opened && window.link().runner()->status().t > 30.0; }, 1000 * most);
  QObject::disconnect(heard);
  return played;
}

QString tenMinutes(const QString& folder) {
  const QString file = folder + "/ten_minutes.capstan";
  const std::string command = test::commandLineProgram() + " simulate --duration 600 --out " +
                              file.toStdString() + " 2>/dev/null >/dev/null";
  return std::system(command.c_str()) == 0 ? file : QString();
}

void memory(const QString& folder, QString file, int cycles, double minutes) {
  if (cycles > 0 && file.isEmpty()) file = tenMinutes(folder);
  if (cycles > 0 && file.isEmpty()) return void(std::printf("no recording was made\n"));
  MainWindow window(folder + "/settings.ini");
  window.resize(1280, 800);
  window.show();
  window.bar().setSpeed(50.0);
  const int warm = std::min(cycles, 5);
  double at_first = 0.0;
  for (int i = 0; i < cycles; ++i) {
    if (!cycle(window, file, 600)) return void(std::printf("cycle %d did not open\n", i));
    if (i == warm - 1) at_first = residentMegabytes();
    if (i % 10 == 9)
      std::printf("  after %2d cycles %7.1f MB, of them allocated %7.1f MB\n", i + 1, residentMegabytes(),
                  allocatedMegabytes()),
          std::fflush(stdout);
  }
  if (cycles > warm)
    std::printf(
        "memory over %d cycles of a 10-minute session: %+.1f MB after the first %d (target: at most +5)\n",
        cycles - warm, residentMegabytes() - at_first, warm);
  if (minutes <= 0.0) return;
  window.bar().setSpeed(1.0);
  window.link().take(std::make_unique<simulation::SimulatedSource>(session(60.0 * minutes + 120.0, 15.0)));
  QTest::qWait(500);
  window.link().setRunning(true);
  QTest::qWait(60'000);
  const double begin = residentMegabytes();
  for (int minute = 1; minute <= std::lround(minutes); ++minute) {
    QTest::qWait(60'000);
    if (minute % 5 == 0)
      std::printf("  after %2d minutes %7.1f MB\n", minute, residentMegabytes()), std::fflush(stdout);
  }
  std::printf(
      "memory over %.0f minutes of running: %+.1f MB (target: at most +5; the plots' own memory is taken at "
      "the start)\n",
      minutes, residentMegabytes() - begin);
}

}  // namespace

int main(int argc, char** argv) {
  base::returnLargeBlocks();  // as the program does
  double seconds = 60.0, minutes = 30.0;
  int cycles = 50, points = 1'000'000;
  std::string session;
  CLI::App options("The window at full load, and its memory");
  options.add_option("--seconds", seconds, "of full load; 0: none");
  options.add_option("--points", points, "points a curve");
  options.add_option("--cycles", cycles, "of opening a recording");
  options.add_option("--session", session, "that recording; default: one of ten minutes is simulated");
  options.add_option("--minutes", minutes, "of running; 0: none");
  CLI11_PARSE(options, argc, argv);
  Watch app(argc, argv);
  app.clock.start();
  const QTemporaryDir folder;
  if (seconds > 0.0) load(app, folder.path(), seconds, points);
  memory(folder.path(), QString::fromStdString(session), cycles, minutes);
  return 0;
}
