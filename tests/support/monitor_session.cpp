/// monitor_session --feed NAME --seconds S [--occlude PERCENT] [--size WxH] [--speed X] [--no-feed]: a
/// simulated session that feeds stereo monitors, without a window. Prints what it did as JSON: for tests and
/// benchmarks of the monitor.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/live/monitor_feed.h"
#include "core/live/runner.h"
#include "core/simulation/simulation_request.h"
#include "core/tracking/make_pipeline.h"
#include "tests/support/process_use.h"

namespace {

using namespace capstan;

int run(int argc, char** argv) {
  std::string feed = "test", trajectory = "fls";
  double seconds = 10.0, occlude = 0.0, speed = 1.0;
  bool no_feed = false;
  CLI::App cli("Simulated session that feeds stereo monitors");
  cli.add_option("--feed", feed, "name of the feed");
  cli.add_option("--seconds", seconds, "duration [s]");
  cli.add_option("--occlude", occlude, "share of the time with both cameras blocked [%]");
  cli.add_option("--speed", speed, "real-time factor, 0: as fast as possible");
  cli.add_option("--trajectory", trajectory, "motion of the robot");
  cli.add_flag("--no-feed", no_feed, "without a feed, for comparison");
  CLI11_PARSE(cli, argc, argv);

  simulation::SimulationRequest request;
  request.trajectory = trajectory;
  request.duration = speed > 0.0 ? seconds * speed + 60.0 : seconds;
  auto source = std::make_unique<simulation::SimulatedSource>(simulation::optionsOf(request));
  const tracking::SourceInfo info = source->info();
  live::Runner runner(std::move(source), tracking::makePipeline(info), {.speed = speed});
  std::unique_ptr<live::MonitorFeed> monitors;
  if (!no_feed) {
    monitors = std::make_unique<live::MonitorFeed>(feed);
    runner.listen(monitors->begin(info));
  }
  if (occlude > 0.0) runner.setOcclusion({.percentage = occlude});
  const auto begin = std::chrono::steady_clock::now();
  runner.run();
  runner.waitUntilIdle(speed > 0.0 ? seconds : 600.0);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  runner.pause();
  runner.waitUntilIdle(5.0);
  const live::RunStatus status = runner.status();
  const tracking::TrackReport report = runner.report();
  const nlohmann::json out = {
      {"state", base::nameOf(status.state)},
      {"error", status.error},
      {"wall", wall.count()},
      {"motor_samples", report.motor_samples},
      {"frames", report.frames},
      {"cpu", test::processorSeconds()},
      {"samples_per_second", static_cast<double>(report.motor_samples) / wall.count()}};
  std::puts(out.dump().c_str());
  return status.error.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "monitor_session: %s\n", error.what());
    return 2;
  }
}
