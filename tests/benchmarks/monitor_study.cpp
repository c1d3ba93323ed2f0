// monitor_study [ROUNDS] [KILLS]: the stereo monitor beside a simulated session (two 640x480 views) under
// Xvfb with Mesa's software renderer: drawing rate at 1280x720, latency from publication to the end of the
// swap, throughput of the session with and without monitors, and monitors that are killed. Exit code 1 if the
// session or the last monitor was disturbed.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/stats/quantile.h"
#include "tests/support/folders.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Runs shell scripts on a display of their own, in a folder of their own.
class Bench {
 public:
  Bench() : folder_(fs::temp_directory_path() / ("capstan_monitor_study_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Bench() { fs::remove_all(folder_); }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void onDisplay(const std::string& script) const {
    std::ofstream(folder_ / "script.sh")
        << "monitor='" << capstan::test::monitorProgram() << " --feed " << feed_ << "'\nsession='"
        << capstan::test::monitorSession() << " --feed " << feed_ << "'\n"
        << script << "\n";
    const std::string command = "cd " + folder_.string() +
                                " && xvfb-run -a -s '-screen 0 1280x720x24 -noreset' sh script.sh >log 2>&1";
    if (std::system(command.c_str()) != 0) std::printf("a script failed; see what follows\n");
  }
  json report(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return file ? json::parse(file, nullptr, false) : json::object();
  }

 private:
  fs::path folder_;
  std::string feed_ = "study-" + std::to_string(getpid());
};

void drawingRate(const Bench& bench) {
  std::printf("drawing rate at 1280x720, two 640x480 views, redrawn all the time beside the session:\n");
  for (const char* layout : {"side-by-side", "top-bottom", "interleaved", "anaglyph", "left"}) {
    bench.onDisplay(std::string("$session --seconds 8 >session.json & session=$!\nsleep 2\n") +
                    "$monitor --layout " + layout +
                    " --redraw --duration 5 --report drawn.json\nwait $session");
    const json drawn = bench.report("drawn.json");
    std::printf("  %-13s %6.1f frames/s  (%s)\n", layout, drawn.value("drawn_per_second", 0.0),
                drawn.value("renderer", "no report").c_str());
  }
}

void latency(const Bench& bench) {
  bench.onDisplay(
      "$session --seconds 64 >session.json & session=$!\nsleep 1\n"
      "$monitor --duration 60 --report shown.json\nwait $session");
  const json shown = bench.report("shown.json");
  const json times = shown.value("latency_ms", json::object());
  std::printf(
      "latency from publication to the end of the swap, 15 pairs/s for 60 s: %d pairs, median %.2f ms, "
      "99 %% %.2f ms, largest %.2f ms; %d copies repeated\n",
      times.value("count", 0), times.value("median", 0.0), times.value("p99", 0.0), times.value("max", 0.0),
      shown.value("overtaken", 0));
}

struct Session {
  double rate;  ///< motor samples per second of wall time
  double cost;  ///< computing time of the session's process per motor sample [s]
};

Session measure(const Bench& bench, const std::string& arguments, const std::string& monitor) {
  bench.onDisplay((monitor.empty() ? "" : monitor + " & monitor=$!\nsleep 2\n") + "$session " + arguments +
                  " >session.json\n" + (monitor.empty() ? "" : "kill $monitor; wait $monitor\n") + "true");
  const json session = bench.report("session.json");
  const double samples = session.value("motor_samples", 0.0);
  return {session.value("samples_per_second", 0.0), session.value("cpu", 0.0) / std::max(samples, 1.0)};
}

void print(const char* what, const std::vector<double>& ratios) {
  const auto q = capstan::stats::quantiles(ratios, std::array{0.0, 0.5, 1.0});
  std::printf("  %-46s %.3f (median; %.3f to %.3f)\n", what, q[1], q[0], q[2]);
}

/// Each round measures a session without a feed, one with a feed, and one with a feed and a monitor.
void throughputs(const Bench& bench, const char* title, const std::string& arguments, int rounds) {
  std::vector<double> feed_rate, feed_cost, monitor_rate, monitor_cost;
  double without_rate = 0.0;
  for (int round = 0; round < rounds; ++round) {
    const Session without = measure(bench, arguments + " --no-feed", {});
    const Session feed = measure(bench, arguments, {}), monitor = measure(bench, arguments, "$monitor");
    feed_rate.push_back(feed.rate / without.rate);
    feed_cost.push_back(feed.cost / without.cost);
    monitor_rate.push_back(monitor.rate / without.rate);
    monitor_cost.push_back(monitor.cost / without.cost);
    without_rate += without.rate / rounds;
  }
  std::printf("session %s, %.0f motor samples/s without a feed; ratios to that, %d rounds:\n", title,
              without_rate, rounds);
  print("throughput with a feed", feed_rate);
  print("throughput with a feed and a monitor", monitor_rate);
  print("its computing time with a feed", feed_cost);
  print("its computing time with a feed and a monitor", monitor_cost);
}

/// The session runs in real time; true if neither it nor the last monitor was disturbed.
bool kills(const Bench& bench, int count) {
  capstan::base::Random random(1);
  double total = 0.0;
  std::string delays;
  for (int i = 0; i < count; ++i) {
    const double delay = random.uniform(0.02, 0.9);
    delays += " " + std::to_string(delay);
    total += delay + 0.1;
  }
  bench.onDisplay("$session --seconds " + std::to_string(total + 20.0) +
                  " >session.json & session=$!\nfor delay in" + delays +
                  "; do\n  $monitor & killed=$!\n  sleep $delay; kill -9 $killed; wait $killed\ndone\n"
                  "$monitor --frames 15 --duration 60 --report last.json\nwait $session");
  const json session = bench.report("session.json"), last = bench.report("last.json");
  const double expected = 15.0 * session.value("wall", 0.0);
  std::printf(
      "%d monitors killed (SIGKILL, after 0.02 to 0.9 s) beside a session in real time: it ran %.1f s, "
      "%.1f motor samples/s, %d of %.0f pairs of images, error: \"%s\"; a monitor after them showed %d "
      "pairs\n",
      count, session.value("wall", 0.0), session.value("samples_per_second", 0.0), session.value("frames", 0),
      expected, session.value("error", "no report").c_str(), last.value("images", 0));
  return session.value("error", "no report").empty() && session.value("frames", 0) > 0.99 * expected - 2.0 &&
         last.value("images", 0) == 15;
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  const int count = argc > 2 ? std::atoi(argv[2]) : 100;
  const Bench bench;
  drawingRate(bench);
  latency(bench);
  if (rounds > 0) {
    throughputs(bench, "in real time", "--seconds 10", rounds);
    throughputs(bench, "as fast as it can", "--speed 0 --seconds 300", rounds);
  }
  return count > 0 && !kills(bench, count);
}
