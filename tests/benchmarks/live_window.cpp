// live_window SETUP --out estimates.csv --json report.json [--record FOLDER]: the window with a live set-up,
// for live_study.py. It runs, and records, until its standard input ends. What the status line says goes to
// standard error. Run it in a display (xvfb-run).

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QSocketNotifier>
#include <QTemporaryDir>
#include <QTimer>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/tracking/side_watch.h"
#include "tests/support/process_use.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"

namespace {

using namespace capstan;
using namespace capstan::widgets;

/// Every estimate of the session, with the time of this computer at which it existed [s since 1970].
class Estimates {
 public:
  live::Listener listener() {
    rows_.reserve(200'000);
    return {[](const tracking::TrackingPipeline&) {},
            [this](const tracking::Sample& sample, const tracking::Snapshot& s) { take(sample, s); }};
  }

  void write(const std::string& path) const {
    std::ofstream file(path);
    file.precision(12);
    file << "t,camera,gate,read_at,q_ukf1,q_ukf2,q_ukf3,q1,q2,q3\n";
    for (const Row& row : rows_) {
      file << row.t << ',' << row.camera << ',' << row.gate << ',' << std::fixed << row.existed
           << std::defaultfloat;
      for (const Eigen::Vector3d& v : {row.q_ukf, row.q})
        for (const double x : v) std::isnan(x) ? file << ',' : file << ',' << x;
      file << '\n';
    }
  }

 private:
  struct Row {
    double t, existed;
    bool camera;
    std::string_view gate;
    Eigen::Vector3d q_ukf, q;
  };

  void take(const tracking::Sample& sample, const tracking::Snapshot& s) {
    if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) {
      if (!rows_.empty() && rows_.back().t == joint->t) rows_.back().q = joint->position;
      return;
    }
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const bool camera = !s.motor_updated;
    rows_.push_back({s.t, std::chrono::duration<double>(now).count(), camera,
                     camera ? base::nameOf(s.gate) : std::string_view(), s.q_link_ukf,
                     Eigen::Vector3d::Constant(std::nan(""))});
  }

  std::vector<Row> rows_;
};

nlohmann::json documentOf(const std::vector<tracking::SideStatus>& sides) {
  nlohmann::json all = nlohmann::json::array();
  for (const tracking::SideStatus& side : sides) {
    const auto latency = side.latency.value_or(tracking::SideLatency{});
    all.push_back({{"side", side.name},
                   {"received", side.received},
                   {"missing", side.missing},
                   {"repeated", side.repeated},
                   {"dropped", side.dropped},
                   {"unpaired", side.unpaired},
                   {"frozen", side.frozen},
                   {"latency", {{"median", latency.median}, {"p99", latency.p99}}}});
  }
  return all;
}

void say(const std::string& sentence) { std::fprintf(stderr, "%s\n", sentence.c_str()); }

struct Options {
  std::string setup, out, json, record;
};

/// Ends the session and writes what it has given.
void finish(MainWindow& window, const Estimates& estimates, const Options& options) {
  live::Runner* runner = window.link().runner();
  nlohmann::json document = {{"processor", test::processorSeconds()}};
  if (runner) {
    runner->pause();
    runner->waitUntilIdle(5.0);
    const live::RunStatus status = runner->status();
    document["live"] = documentOf(status.sides);
    if (status.recorder)
      document["recorder"] = {{"written", status.recorder->written},
                              {"dropped", status.recorder->dropped},
                              {"lost", status.recorder->lost}};
    runner->stopRecording();
    runner->listen({});
  }
  estimates.write(options.out);
  std::ofstream(options.json) << document.dump(1) << '\n';
  QApplication::quit();
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App commands("The window with a live set-up");
  commands.add_option("SETUP", options.setup)->required();
  commands.add_option("--out", options.out)->required();
  commands.add_option("--json", options.json)->required();
  commands.add_option("--record", options.record);
  CLI11_PARSE(commands, argc, argv);
  QApplication app(argc, argv);
  const QTemporaryDir folder;
  Estimates estimates;
  MainWindow window(folder.path() + "/settings.ini");
  window.resize(1280, 800);
  window.show();
  tracking::SideWatch watch;
  QObject::connect(&window.link(), &SessionLink::failed,
                   [](const QString& fault) { say(fault.toStdString()); });
  QObject::connect(&window.link(), &SessionLink::opened, [&](const tracking::SourceInfo&) {
    window.link().listen(&window, estimates.listener());
    window.link().setRunning(true);
    if (!options.record.empty()) window.link().toggleRecording(QString::fromStdString(options.record));
    say("waiting for rows");
  });
  QObject::connect(&window.link(), &SessionLink::status, [&](const live::RunStatus& status) {
    for (const std::string& sentence : watch.observe(status.sides)) say(sentence);
  });
  QSocketNotifier input(0, QSocketNotifier::Read);
  QObject::connect(&input, &QSocketNotifier::activated, [&] {
    input.setEnabled(false);
    finish(window, estimates, options);
  });
  window.open(SourceChoice::ofLive(QString::fromStdString(options.setup)));
  return QApplication::exec();
}
