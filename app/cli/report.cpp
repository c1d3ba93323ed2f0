#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <variant>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/health_output.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "app/cli/report_figures.h"
#include "app/cli/report_pages.h"
#include "app/cli/report_rows.h"
#include "app/cli/simulation_arguments.h"
#include "app/cli/track_output.h"
#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/base/yaml.h"
#include "core/experiments/identify_and_track.h"
#include "core/recording/recorder.h"
#include "core/recording/recording_kinds.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::cli {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string file, format = "auto", read_as, robot, options, out = "report", json;
  std::string opened, theme;  ///< values of the window's options
  bool simulate = false;
  simulation::SimulationRequest simulation;
};

bool holdsReport(const fs::path& folder) {
  std::stringstream text;
  text << std::ifstream(folder / "index.html").rdbuf();
  return text.str().find(kReportMark) != std::string::npos;
}

/// Prepares the report's folder: it must be new, empty, or hold a former report, whose files (and no others)
/// are removed. Writes a front page that marks an unfinished report, so that a failed run can be repeated
/// into the same folder. Throws base::InputError.
void makeRoom(const fs::path& folder, const std::string& recording) {
  std::error_code failed;
  if (fs::exists(folder) && !fs::is_directory(folder))
    refuseFile(folder.string(), "is a file", "Give a folder as --out");
  if (fs::is_directory(folder) && !fs::is_empty(folder)) {
    if (!holdsReport(folder))
      refuseFile(folder.string(), "is not empty and holds no former report", "Give another --out");
    for (const std::string& name : reportFiles())
      if (!recording.empty() && fs::equivalent(folder / name, recording, failed))
        refuseFile(recording, "lies in the report that would be replaced", "Give another --out");
    for (const std::string& name : reportFiles()) fs::remove(folder / name, failed);
  }
  fs::create_directories(folder, failed);
  if (failed) refuseFile(folder.string(), "cannot be made: " + failed.message(), "Give another --out");
  base::checkWritable(folder / "index.html");
  base::writeTextFile(folder / "index.html",
                      std::string(kReportMark) + "<p>This report was not finished.</p>\n");
}

/// Recorder for a source that runs faster than the disk: it waits where a live session would drop samples.
class PatientRecorder {
 public:
  PatientRecorder(const fs::path& file, const recording::SessionHeader& header)
      : recorder_(file, header, hastyCommits()) {}

  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
    recorder_.offer(sample);
    if (std::holds_alternative<tracking::MotorSample>(sample)) recorder_.offer(snapshot);
    if (++added_ % kBetweenUpdates != 0) return;
    for (auto now = recorder_.stats();
         now.state == recording::RecorderState::kRecording && now.queued - now.written > kMostWaiting;
         now = recorder_.stats())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  /// Closes the file. Throws base::InputError when it does not hold every sample.
  void close() {
    recorder_.close();
    const auto stats = recorder_.stats();
    if (!stats.error.empty() || stats.dropped > 0)
      refuseFile(recorder_.path().string(),
                 stats.error.empty() ? fmt::format("lacks {} rows", stats.dropped) : stats.error,
                 "Is the disk full?");
  }

 private:
  static constexpr std::uint64_t kBetweenUpdates = 64, kMostWaiting = 1000;
  static recording::RecorderOptions hastyCommits() {
    recording::RecorderOptions options;
    options.commit_interval = 0.02;
    return options;
  }

  recording::Recorder recorder_;
  std::uint64_t added_ = 0;
};

struct LastFrame {
  tracking::StereoFrame frame;
  std::array<vision::MarkerDetection, 2> marker;

  void keep(const tracking::StereoFrame& newest, const tracking::Snapshot& snapshot) {
    newest.left.copyTo(frame.left);
    newest.right.copyTo(frame.right);
    marker = snapshot.marker;
  }
  /// Writes left.png and right.png. Returns false if there was no pair of images.
  bool save(const fs::path& folder) const {
    if (frame.left.empty() || frame.right.empty()) return false;
    const auto write = [&](const char* name, const cv::Mat& image, const vision::MarkerDetection& found) {
      if (!cv::imwrite((folder / name).string(), drawDetection(image, found)))
        refuseFile((folder / name).string(), "cannot be written", "Is the disk full?");
    };
    write("left.png", frame.left, marker[0]);
    write("right.png", frame.right, marker[1]);
    return true;
  }
};

/// Opens the recording again from its beginning; of a simulation, the session that was recorded.
std::unique_ptr<tracking::Source> openAgain(const ReportArguments& arguments) {
  if (arguments.file.empty())
    return openSource((fs::path(arguments.out) / "session.capstan").string(), RecordingFormat::kSession, {},
                      {});
  return openSource(arguments.file, formatOf(arguments.format, arguments.file), arguments.robot,
                    readAsOf(arguments.read_as), Notices::kQuiet);
}

experiments::IdentifyAndTrack identifyAndTrack(const ReportArguments& arguments,
                                               const identification::IdentificationData& data,
                                               const tracking::TrackingOptions& options,
                                               base::Progress& progress) {
  const ProgressLine line(progress);
  return experiments::identifyAndTrack(data, *openAgain(arguments), options, progress);
}

std::unique_ptr<tracking::Source> openFor(ReportArguments& arguments, const CLI::App& command) {
  arguments.simulation.robot = arguments.robot;
  const recording::ReadAs read_as = readAsOf(arguments.read_as);
  if (arguments.file.empty() && !read_as.empty())
    refuseOption(kReadAs, arguments.read_as, "is given without RECORDING", "Give a measured table");
  if (arguments.file.empty()) return makeSimulation(arguments.simulation);
  if (simulationAsked(command))
    refuseOption("RECORDING", arguments.file, "is given together with simulation options",
                 "Give one of them");
  return openSource(arguments.file, formatOf(arguments.format, arguments.file), arguments.robot, read_as);
}

/// Applies the window's options --session, --table and --simulate to `arguments`. Throws base::InputError.
void takeWindowOptions(ReportArguments& arguments, const CLI::App& command) {
  if (!arguments.opened.empty()) {
    if (!arguments.file.empty())
      refuseOption("RECORDING", arguments.file, "is given together with " + arguments.opened,
                   "Give one of them");
    arguments.file = arguments.opened;
  }
  if (arguments.simulate && !arguments.file.empty())
    refuseOption("RECORDING", arguments.file, "is given together with --simulate", "Give one of them");
  if (arguments.file.empty() && command.count("--format") > 0)
    refuseOption("--format", arguments.format, "is for a RECORDING, and none is given",
                 "Give one, or leave it out");
  if (!arguments.theme.empty()) notice("--theme is an option of the window: ignored");
}

/// Declares the window's options, which packaging/run passes on where there is no display.
void addWindowOptions(CLI::App& command, ReportArguments& arguments) {
  const auto grouped = [](CLI::Option* option) { return option->group("Options of the window"); };
  auto* session = grouped(command.add_option("--session", arguments.opened, "same as RECORDING"));
  grouped(command.add_option("--table", arguments.opened, "same as RECORDING"))->excludes(session);
  grouped(command.add_flag("--simulate", arguments.simulate, "simulate (default without RECORDING)"));
  command
      .add_flag_callback(
          "--unregistered", [&arguments] { arguments.simulation.registered = false; },
          "unknown camera pose: the filter uses kinematics alone")
      ->group("Simulation");
  grouped(command.add_option("--theme", arguments.theme, "without effect: figures of a report are light"));
}

ExitCode report(ReportArguments& arguments, const CLI::App& command) {
  takeWindowOptions(arguments, command);
  const Output output(arguments.json);
  const fs::path folder = arguments.out;
  checkOutputs({{"--json", arguments.json}},
               withFilesOf(arguments.simulation, {arguments.file, arguments.robot, arguments.options}));
  const auto source = openFor(arguments, command);
  const tracking::SourceInfo info = source->info();
  const auto options = arguments.options.empty() ? tracking::trackingOptionsOf(info)
                                                 : tracking::readTrackingOptions(arguments.options);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info, options);
  makeRoom(folder, arguments.file);

  recording::SessionHeader header = recording::headerOf(info, isoNow());
  header.tracking = base::writeYaml(options);
  const bool simulates = arguments.file.empty();
  std::optional<PatientRecorder> recorder;
  if (simulates) recorder.emplace(folder / "session.capstan", header);
  EstimateWriter estimates((folder / "estimates.csv").string());
  ReportFigures figures;
  LastFrame last;
  identification::DataCollector collector(pipeline, info.title);

  base::Progress progress;
  tracking::TrackReport result;
  {
    const ProgressLine line(progress);
    result = tracking::trackAll(*source, pipeline, &progress, info.duration,
                                [&](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                                  if (recorder) recorder->add(sample, snapshot);
                                  estimates.add(sample, snapshot);
                                  figures.add(snapshot);
                                  collector.add(sample, snapshot);
                                  if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample))
                                    last.keep(*frame, snapshot);
                                });
    estimates.close();
    if (recorder) recorder->close();
  }
  const experiments::IdentifyAndTrack after =
      result.cancelled || result.motor_samples == 0
          ? experiments::IdentifyAndTrack{}
          : identifyAndTrack(arguments, collector.finish(), options, progress);

  std::array<std::string, 3> names;
  for (std::size_t i = 0; i < names.size() && i < info.robot.joints.size(); ++i)
    names[i] = info.robot.joints[i].name;
  ReportPage page{.title = info.title,
                  .created = header.created,
                  .software = header.software,
                  .recording = simulates ? "session.capstan" : fs::path(arguments.file).filename().string(),
                  .simulated = simulates || !info.truth.empty(),
                  .recorded_here = simulates};
  page.own_kinematics = info.own_kinematics;
  page.robot = info.robot.name;
  page.health = tracking::healthOf(result, info.robot, options.memory);
  page.rows = reportRows(result, after, info.own_kinematics);
  page.plots = figures.save(names, folder);
  page.plots_begin = figures.begin();
  page.plots_end = figures.end();
  page.pictures = last.save(folder);
  base::writeTextFile(folder / "errors.csv", errorsCsv(result.errors));
  base::writeTextFile(folder / "errors.md", errorsMarkdown(result.errors));
  base::writeTextFile(folder / "index.html", indexHtml(page, result));

  output.text(fmt::format("robot          {}\n", info.robot.name) + textOf(result, info, 0.0) +
              healthText(page.health) + textOf(page.rows) +
              fmt::format("\nreport         {}\n", (folder / "index.html").string()));
  nlohmann::json document = jsonOf(result, info);
  document["health"] = healthJson(page.health);
  document["identified"] = jsonOf(after, info);
  output.json(document);
  if (after.cancelled) notice("cancelled: the identified constants are not in the report");
  if (result.cancelled) notice("cancelled: the report covers the time until then");
  if (result.motor_samples == 0) notice("the recording holds no motor sample: nothing was tracked");
  return result.cancelled || after.cancelled || result.motor_samples == 0 ? kFailed : kOk;
}

}  // namespace

void addReport(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<ReportArguments>();
  arguments->simulation.duration = 20.0;
  CLI::App* command = app.add_subcommand(
      "report", "Write a folder with plots, images and errors of a recording or a simulation");
  command->add_option("RECORDING", arguments->file, recording::recordingKinds() + "; default: simulate");
  command->add_option("--out", arguments->out, "folder: new, empty, or with a former report to replace")
      ->capture_default_str();
  command->add_option("--format", arguments->format, "format of RECORDING: auto, session, table, raven")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "session", "table", "raven"}));
  addReadAs(*command, arguments->read_as);
  command->add_option("--robot", arguments->robot, "robot file; a session contains its own");
  command->add_option(
      "--options", arguments->options,
      "file of filter options (format: resources/tracking/default.yaml); a session contains its own");
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  addSimulationOptions(*command, arguments->simulation);
  addWindowOptions(*command, *arguments);
  command->footer(
      "Examples:\n"
      "  capstan-cli report                              (20 s simulated, into the folder report)\n"
      "  capstan-cli report --duration 60 --seed 7 --out trial\n"
      "  capstan-cli report trial.capstan --out trial_report");
  command->callback([arguments, command, &exit] { exit = report(*arguments, *command); });
}

}  // namespace capstan::cli
