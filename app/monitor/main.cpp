#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/monitor/monitor.h"
#include "app/numbers.h"
#include "app/version.h"
#include "core/base/error.h"

namespace {

using capstan::monitor::Options;
using capstan::monitor::Report;

std::atomic<bool> stopped{false};
void stop(int) { stopped = true; }

/// Lowers the priority of this process and of the threads that it will start: on a busy machine, above all
/// with a software renderer, the session goes first.
void giveWay() {
  constexpr int kNice = 10;
  setpriority(PRIO_PROCESS, 0, kNice);
}

nlohmann::json jsonOf(const Report& report, const Options& options) {
  const double seconds = std::max(report.seconds, 1e-9);
  return {{"schema", 1},
          {"feed", options.feed},
          {"layout", options.layout},
          {"seconds", report.seconds},
          {"drawn", report.drawn},
          {"drawn_per_second", static_cast<double>(report.drawn) / seconds},
          {"images", report.images},
          {"images_per_second", static_cast<double>(report.images) / seconds},
          {"sessions", report.sessions},
          {"overtaken", report.overtaken},
          {"latency_ms",
           {{"count", report.latency.count},
            {"median", 1e3 * report.latency.median},
            {"p99", 1e3 * report.latency.high},
            {"max", 1e3 * report.latency.most}}},
          {"renderer", report.renderer}};
}

std::string textOf(const Report& report) {
  const double seconds = std::max(report.seconds, 1e-9);
  std::string text =
      fmt::format("{} frames drawn in {:.1f} s ({:.1f}/s), {} of them with new images ({:.1f}/s)\n",
                  report.drawn, seconds, static_cast<double>(report.drawn) / seconds, report.images,
                  static_cast<double>(report.images) / seconds);
  if (report.latency.count > 0)
    text += fmt::format(
        "latency from publication to the end of the swap: median {:.2f} ms, 99 % {:.2f} ms, largest {:.2f} "
        "ms\n",
        1e3 * report.latency.median, 1e3 * report.latency.high, 1e3 * report.latency.most);
  return text;
}

void write(const Report& report, const Options& options) {
  if (options.report != "-") std::fputs(textOf(report).c_str(), stdout);
  if (options.report.empty()) return;
  const std::string json = jsonOf(report, options).dump(2) + "\n";
  if (options.report == "-") {
    std::fputs(json.c_str(), stdout);
    return;
  }
  std::ofstream file(options.report);
  file << json;
  if (!file.flush())
    throw capstan::base::InputError({options.report, 0, {}, {}, "cannot be written", "Check the path"});
}

capstan::LibraryVersions libraries() {
  int major = 0, minor = 0, revision = 0;
  glfwGetVersion(&major, &minor, &revision);
  return {{"OpenCV", cv::getVersionString()}, {"GLFW", fmt::format("{}.{}.{}", major, minor, revision)}};
}

int run(int argc, char** argv) {
  Options options;
  CLI::App cli(
      "Capstan's stereo monitor: both cameras of a running session, with the arm where the filter has it",
      "capstan-monitor");
  cli.set_version_flag("--version", capstan::versionText("capstan-monitor", libraries()));
  cli.get_formatter()->column_width(34);
  addOptions(cli, options);
  capstan::checkNumbers(cli);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? 0 : 2;
  }
  const auto size = capstan::monitor::windowSizeOf(options.size);
  capstan::live::segmentName(options.feed);
  giveWay();
  const capstan::monitor::WindowSystem system;
  if (options.list_displays) {
    for (const std::string& line : system.displays()) fmt::print("{}\n", line);
    return 0;
  }
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  capstan::monitor::Window window(size, options.display, options.full_screen);
  capstan::monitor::Monitor monitor(options, window);
  const Report report = monitor.run(stopped);
  if (!options.screenshot.empty()) monitor.save(options.screenshot);
  write(report, options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capstan-monitor: %s\n", error.what());
    return 2;
  }
}
