#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/health_output.h"
#include "app/cli/live_option.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "app/cli/track_output.h"
#include "core/live/recorder_options.h"
#include "core/live/runner.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::cli {
namespace {

struct RecordArguments {
  std::string live, out, robot, read_as, monitor_feed, json;
  std::vector<std::string> publish;
  double duration = 0.0;
};

constexpr double kLongestStop = 5.0;  // [s]

/// Waits until the robot's stream or the recording has ended. Ctrl-C ends the recording, which is complete.
void waitForEnd(live::Runner& runner, const base::Progress& progress) {
  while (!progress.cancelled() && !runner.waitUntilIdle(0.1)) {
    const auto recorder = runner.status().recorder;
    if (recorder && recorder->state == recording::RecorderState::kFailed) return;
  }
}

ExitCode record(const RecordArguments& arguments) {
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, {arguments.robot});
  if (std::filesystem::path(arguments.out).extension() != recording::kSessionSuffix)
    refuseOption("--out", arguments.out, "does not end in .capstan", "Give a name with .capstan");
  if (std::filesystem::exists(arguments.out))  // before a program is waited for
    refuseFile(arguments.out, "exists already", "Choose another name");
  const Output output(arguments.json);
  const std::unique_ptr<live::MonitorFeed> feed = makeMonitorFeed(arguments.monitor_feed);
  const std::unique_ptr<live::EstimateOutputs> outputs = makeEstimateOutputs(arguments.publish);
  std::unique_ptr<tracking::Source> source =
      openLive(arguments.live, arguments.robot, arguments.read_as, arguments.duration);
  const tracking::SourceInfo info = source->info();
  if (const std::string text = unregisteredText(info); !text.empty()) notice(text);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info, tracking::trackingOptionsOf(info));
  auto runner = std::make_unique<live::Runner>(std::move(source), std::move(pipeline));
  if (feed || outputs)
    runner->listen(live::both(feed ? feed->begin(info) : live::Listener{},
                              outputs ? outputs->begin(info) : live::Listener{}));
  runner->startRecording(arguments.out, recording::headerOf(info, isoNow()),
                         live::recorderOptionsFor(info, runner->status()));
  base::Progress progress;
  {
    const ProgressLine line(progress);
    const SideNotices notices([&] { return runner->status().sides; });
    runner->run();
    waitForEnd(*runner, progress);
  }
  runner->stopRecording();  // before the pause, which is none of the session
  runner->pause();
  runner->waitUntilIdle(kLongestStop);
  const live::RunStatus status = runner->status();
  const tracking::TrackReport report = runner->report();
  const std::vector<tracking::HealthCheck> health = runner->health();
  const auto recorder = runner->recorder();
  runner.reset();  // closes the recording
  const recording::RecorderStats stats = recorder->stats();
  const bool empty = stats.written == 0 && stats.error.empty();
  std::error_code ignored;
  if (empty) std::filesystem::remove(arguments.out, ignored);
  output.text(textOf(report, info, 0.0) + healthText(health) + textOf(status.sides) +
              fmt::format("{}: {} rows written, {} dropped, {} lost, {:.1f} MB\n", arguments.out,
                          stats.written, stats.dropped, stats.lost, 1e-6 * static_cast<double>(stats.bytes)));
  output.json({{"file", empty ? nlohmann::json() : nlohmann::json(arguments.out)},
               {"written", stats.written},
               {"frames", stats.frames},
               {"dropped", stats.dropped},
               {"lost", stats.lost},
               {"bytes", stats.bytes},
               {"motor", report.motor_samples},
               {"health", healthJson(health)},
               {"live", jsonOf(status.sides)}});
  if (!stats.error.empty()) notice(stats.error);
  if (!status.error.empty()) notice(status.error);
  if (empty) notice(fmt::format("{}; {} is not kept", nothingCameText(status.sides), arguments.out));
  const std::uint64_t missing = stats.dropped + stats.lost;
  if (missing > 0 && stats.error.empty()) notice(recording::gapsText(missing));
  return missing == 0 && stats.error.empty() && status.error.empty() && report.motor_samples > 0 ? kOk
                                                                                                 : kFailed;
}

}  // namespace

void addRecord(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<RecordArguments>();
  CLI::App* command = app.add_subcommand("record", "Track a robot live and record the session");
  addLive(*command, arguments->live)->required();
  command->add_option("--out", arguments->out, "session file to write (.capstan)")->required();
  command
      ->add_option("--duration", arguments->duration,
                   "end after this time [s], from the first row (without a row: 10 s later, from the\n"
                   "start); default: until Ctrl-C")
      ->check(CLI::Range(0.1, 86400.0));
  command->add_option("--robot", arguments->robot, "nominal robot file; default: the left RAVEN-II");
  addReadAs(*command, arguments->read_as);
  addMonitorFeed(*command, arguments->monitor_feed);
  addPublish(*command, arguments->publish);
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli record --live tcp://127.0.0.1:5555 --out trial.capstan --duration 60\n"
      "  robot_program | capstan-cli record --live - --out trial.capstan");
  command->callback([arguments, &exit] { exit = record(*arguments); });
}

}  // namespace capstan::cli
