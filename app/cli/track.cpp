#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/cli/centroid_study.h"
#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/health_output.h"
#include "app/cli/live_option.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "app/cli/registering.h"
#include "app/cli/simulation_arguments.h"
#include "app/cli/track_output.h"
#include "core/base/error.h"
#include "core/live/motor_failures.h"
#include "core/live/occluded_source.h"
#include "core/recording/recording_kinds.h"
#include "core/tracking/gate_watch.h"
#include "core/tracking/make_pipeline.h"
#include "core/vision/registration_file.h"

namespace capstan::cli {
namespace {

struct TrackArguments {
  std::string file, live, out_format = "auto", format = "auto", robot, estimator_robot, options,
                          registration = "stored", mounting, out, save_registration, read_as, topics,
                          monitor_feed, json;
  bool simulate = false, whole_frame = false;
  double occlude = 0.0;
  std::vector<std::string> fail_motor, publish;
  std::vector<int> failed_motors;
  simulation::SimulationRequest simulation;
};

/// One source: FILE, --simulate or --live.
void checkSource(const TrackArguments& arguments, const CLI::App& command) {
  const bool live = !arguments.live.empty();
  if (arguments.simulate && !arguments.file.empty())
    refuseOption("FILE", arguments.file, "is given together with --simulate", "Give one of them");
  if (live && (arguments.simulate || !arguments.file.empty()))
    refuseOption("--live", arguments.live, "is given together with FILE or --simulate", "Give one of them");
  if (!live && !arguments.simulate && arguments.file.empty())
    refuseOption("FILE", {}, "is missing", "Give a recording, --live or --simulate");
  if (!arguments.simulate && simulationAsked(command, live ? "--duration" : ""))
    refuseOption("--simulate", {}, "is missing, yet simulation options are given",
                 "Add --simulate or leave them out");
  if ((arguments.simulate || live) && command.count("--format") > 0)
    refuseOption("--format", arguments.format, "is for a FILE", "Leave it out");
  if (live && (arguments.registration == "hard-stop" || arguments.registration == "kinematics"))
    refuseOption("--register", arguments.registration, "needs a recording that can be read twice",
                 "Record first (record --live), or give a registration file");
}

/// Whether --out names other programs instead of a file.
bool streamsOut(const TrackArguments& arguments) { return live::isAddress(arguments.out); }

/// What happens with each sample and snapshot of a session.
struct EachSample {
  EstimateWriter& estimates;
  std::optional<CentroidStudy>& study;
  const live::Listener& listener;
  bool reference;  ///< joint samples follow the motor samples
  bool live;
  tracking::GateWatch gate = {};

  void operator()(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
    estimates.add(sample, snapshot);
    if (live)
      if (const auto sentence = gate.observe(snapshot)) notice(*sentence);
    if (study) study->add(snapshot);
    if (listener) listener.take(sample, snapshot);
  }
  void waiting() const {
    if (!reference) estimates.waiting();
  }
};

void check(const TrackArguments& arguments, const CLI::App& command) {
  checkSource(arguments, command);
  if (arguments.out == "-" && arguments.json == "-")
    refuseOption("--json", "-", "is given together with --out -", "Write one of them to a file");
  if (streamsOut(arguments) && arguments.out != "-" && arguments.live.empty())
    refuseOption("--out", arguments.out, "is given without --live", "Give a file, or - for standard output");
  if (arguments.simulate && !arguments.read_as.empty())
    refuseOption(kReadAs, arguments.read_as, "is given together with --simulate", "Give one of them");
  if (!arguments.mounting.empty() && arguments.registration != "hard-stop")
    refuseOption("--mounting", arguments.mounting, "is given without --register hard-stop",
                 "Add that, or leave it out");
}

std::vector<live::MotorFailure> failuresOf(const std::vector<std::string>& texts) {
  std::vector<live::MotorFailure> all;
  for (const std::string& text : texts) {
    const auto failures = live::parseMotorFailure(text, "--fail-motor");
    all.insert(all.end(), failures.begin(), failures.end());
  }
  return all;
}

/// Line with the robot that the filter assumed and its origin.
std::string robotText(const TrackArguments& arguments, const robot::Description& robot) {
  const bool session = !arguments.file.empty() && detectFormat(arguments.file) == RecordingFormat::kSession;
  const std::string from = !arguments.estimator_robot.empty() ? "of " + arguments.estimator_robot
                           : !arguments.robot.empty()         ? "of " + arguments.robot
                           : session                          ? "of the session"
                                                              : "nominal";
  return fmt::format("robot          {} ({})\n", robot.name, from);
}

/// Prints a notice for each failure after the end of the recording, because it has no effect.
void noticeLate(const std::vector<live::MotorFailure>& failures, const tracking::SourceInfo& info) {
  for (const live::MotorFailure& failure : failures)
    if (info.duration > 0.0 && failure.time > info.duration)
      notice(fmt::format("--fail-motor: the recording ends at {:.4g} s, before {:.4g} s", info.duration,
                         failure.time));
}

ExitCode track(TrackArguments& arguments, const CLI::App& command) {
  check(arguments, command);
  const recording::ReadAs read_as = readAsOf(arguments.read_as);
  const std::vector<live::MotorFailure> failures = failuresOf(arguments.fail_motor);
  checkOutputs(
      {{"--out", streamsOut(arguments) ? std::string() : arguments.out},
       {"--save-registration", arguments.save_registration},
       {"--json", arguments.json}},
      withFilesOf(arguments.simulation, {arguments.file, arguments.robot, arguments.estimator_robot,
                                         arguments.options, arguments.registration, arguments.mounting}));
  const Output output(arguments.json);
  const bool text_here = arguments.out != "-";  // standard output belongs to the estimates
  arguments.simulation.robot = arguments.robot;
  const RecordingFormat format =
      arguments.file.empty() ? RecordingFormat::kTable : formatOf(arguments.format, arguments.file);
  const SourceFactory open = [&]() -> std::unique_ptr<tracking::Source> {
    if (arguments.simulate) return makeSimulation(arguments.simulation);
    if (!arguments.live.empty())
      return openLive(arguments.live, arguments.robot, arguments.read_as,
                      command.count("--duration") > 0 ? arguments.simulation.duration : 0.0);
    return openSource(arguments.file, format, arguments.robot, read_as, Notices::kSaid, arguments.topics);
  };

  const auto source = open();
  tracking::SourceInfo info = source->info();
  if (!arguments.estimator_robot.empty())
    info.robot = robot::readDescriptionOrDefault(arguments.estimator_robot);
  auto options = arguments.options.empty() ? tracking::trackingOptionsOf(info)
                                           : tracking::readTrackingOptions(arguments.options);
  if (arguments.whole_frame) options.roi_search = false;
  if (arguments.registration != "stored") {
    std::string message;
    info.base_from_camera = registerBy(arguments.registration, arguments.mounting, open, options, message);
    notice(message);
  } else if (info.rig && !info.base_from_camera) {
    notice(
        arguments.live.empty()
            ? "no registration is stored with this recording: the filter runs on kinematics (see --register)"
            : unregisteredText(info) + ", or give it with --register");
  }
  if (!arguments.save_registration.empty() && !info.base_from_camera)
    refuseOption("--save-registration", arguments.save_registration, "has no registration to write",
                 "Find one with --register");
  if (!arguments.save_registration.empty())
    vision::writeRegistration(*info.base_from_camera, arguments.save_registration);

  noticeLate(failures, info);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info, options);
  for (const int motor : arguments.failed_motors) pipeline.setMotorFailed(motor - 1, true);
  live::FailingMotors failing(*source, failures);
  const live::OcclusionSchedule occlusion{.percentage = arguments.occlude};
  live::OccludedSource occluded(failing, occlusion);
  const bool live = !arguments.live.empty();
  EstimateWriter estimates(arguments.out,
                           live ? EstimateWriter::Session::kLive : EstimateWriter::Session::kRecorded,
                           arguments.out_format);
  if (const live::RowStream* stream = estimates.stream()) notice("estimates go to " + stream->name());
  std::optional<CentroidStudy> study;
  if (const auto* simulated = dynamic_cast<const simulation::SimulatedSource*>(source.get());
      simulated && info.rig)
    study.emplace(*simulated, occlusion);

  const std::unique_ptr<live::MonitorFeed> feed = makeMonitorFeed(arguments.monitor_feed);
  const std::unique_ptr<live::EstimateOutputs> outputs = makeEstimateOutputs(arguments.publish);
  const live::Listener listener = live::both(feed ? feed->begin(info) : live::Listener{},
                                             outputs ? outputs->begin(info) : live::Listener{});
  if (listener) listener.begin(pipeline);

  base::Progress progress;
  tracking::TrackReport report;
  std::chrono::duration<double> spent{};
  {
    const ProgressLine line(progress);
    std::optional<SideNotices> notices;
    if (live && arguments.live != "-") notices.emplace([&] { return source->sides(); });
    const auto begin = std::chrono::steady_clock::now();
    report = tracking::trackAll(occluded, pipeline, &progress, info.duration,
                                EachSample{estimates, study, listener, info.reference, live});
    spent = std::chrono::steady_clock::now() - begin;
  }
  estimates.close();

  tracking::noteSource(info, source->sides(), report);
  const auto health = tracking::healthOf(report, info.robot, options.memory);
  const bool paced = info.real_time && !info.sender_waits;  // by the robot: a speed would say nothing
  std::string text = textOf(report, info, paced ? 0.0 : spent.count()) + healthText(health);
  nlohmann::json document = cli::documentOf(report, info, health, arguments.estimator_robot);
  if (study && report.frames > 0) {
    text += study->text();
    document["centroid"] = study->json();
  }
  if (const live::RowStream* stream = estimates.stream()) {
    const live::RowStreamCounts counts = stream->counts();
    text += fmt::format("estimates      {} rows to {}, {} readers, {} dropped for slow readers\n",
                        counts.rows, stream->name(), counts.readers, counts.dropped);
    document["stream"] = {{"to", stream->name()},
                          {"rows", counts.rows},
                          {"readers", counts.readers},
                          {"dropped", counts.dropped}};
  }
  if (!arguments.live.empty() && arguments.live != "-") {
    text += textOf(source->sides());
    document["live"] = jsonOf(source->sides());
  }
  text += robotText(arguments, info.robot);
  if (text_here) output.text(text);
  output.json(document);
  const bool until_cancelled = live && command.count("--duration") == 0;  // Ctrl-C is its end
  const bool cancelled = report.cancelled && !until_cancelled;
  if (cancelled) notice("cancelled: the numbers cover the time until then");
  if (report.motor_samples == 0)
    notice(live ? nothingCameText(source->sides())
                : "the recording holds no motor sample: nothing was tracked");
  return cancelled || report.motor_samples == 0 ? kFailed : kOk;
}

}  // namespace

void addTrack(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<TrackArguments>();
  CLI::App* command =
      app.add_subcommand("track", "Estimate the joint angles of a recording, or of a simulation");
  command->add_option("FILE", arguments->file, recording::recordingKinds());
  command->add_option("--format", arguments->format, "format of FILE: auto, session, table, raven")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "session", "table", "raven"}));
  addLive(*command, arguments->live);
  addReadAs(*command, arguments->read_as);
  addTopics(*command, arguments->topics);
  command->add_option("--robot", arguments->robot,
                      "nominal robot file; with --simulate, the simulated robot is built from it too; a "
                      "session contains its\n"
                      "own");
  command->add_option("--estimator-robot", arguments->estimator_robot,
                      "robot that the filter assumes, e.g. an identified robot; default: the nominal one");
  command->add_option(
      "--options", arguments->options,
      "file of filter options (format: resources/tracking/default.yaml); a session contains its own");
  command
      ->add_option(
          "--register", arguments->registration,
          "how the cameras are registered. stored: as in the recording; hard-stop: computed from images\n"
          "at rest at the hard stop; kinematics: fitted to the motors' kinematics over the whole\n"
          "movement; or a registration file")
      ->capture_default_str();
  command->add_option("--mounting", arguments->mounting,
                      "registration file with the known rotation for --register hard-stop");
  command->add_option("--save-registration", arguments->save_registration,
                      "file for the registration in use");
  command
      ->add_option("--occlude", arguments->occlude,
                   "block both cameras for this share of the time, in intervals of 2 s [%]")
      ->check(CLI::Range(0.0, 95.0));
  command
      ->add_option(
          "--fail-motor", arguments->fail_motor,
          "MOTOR@SECONDS[:frozen|lost]: make the encoder of motor MOTOR (1, 2, 3 or all) fail at the time\n"
          "SECONDS (default: frozen); repeatable")
      ->allow_extra_args(false);  // FILE may come next
  command
      ->add_option(
          "--failed-motor", arguments->failed_motors,
          "ignore this motor's encoder (1, 2, 3) and estimate its joint from the camera alone; repeatable")
      ->allow_extra_args(false)
      ->check(CLI::Range(1, 3));
  command
      ->add_option(
          "--out", arguments->out,
          "estimates, one row per motor or camera sample: a file (.csv or .jsonl), or - for standard\n"
          "output; with --live also a FIFO, or tcp://ADDRESS:PORT to listen on")
      ->expected(1);
  command
      ->add_option("--out-format", arguments->out_format,
                   "format of the estimates: auto (by the suffix of --out, else CSV), csv, jsonl")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "csv", "jsonl"}));
  addMonitorFeed(*command, arguments->monitor_feed);
  addPublish(*command, arguments->publish);
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  command->add_flag("--whole-frame", arguments->whole_frame,
                    "search the whole of every image, without regions of interest");
  command->add_flag("--simulate", arguments->simulate,
                    "track a simulated session, without a file in between");
  addSimulationOptions(*command, arguments->simulation);
  command->get_option("--duration")
      ->description(
          "duration of the movement [s]; with --live: end after this time, from the first row (without a "
          "row:\n"
          "10 s later, from the start); default there: until Ctrl-C");
  command->footer(
      "Examples:\n"
      "  capstan-cli track trial.capstan --out estimates.csv\n"
      "  capstan-cli track recording.csv --robot my_robot.yaml --json -\n"
      "  capstan-cli track degrees.csv --read-as q_m=deg,q1=deg,q2=deg,p_c=mm\n"
      "  capstan-cli track trial.capstan --estimator-robot identified.yaml\n"
      "  capstan-cli track trial.bag --topics motors=/PSM1/actuators/measured_js\n"
      "  capstan-cli track --live tcp://127.0.0.1:5555 --duration 60\n"
      "  capstan-cli track --live tcp://127.0.0.1:5555 --out tcp://127.0.0.1:5556 --out-format jsonl\n"
      "  robot_program | capstan-cli track --live - --robot my_robot.yaml --out estimates.csv\n"
      "  capstan-cli track joints123.csv                 (RAVEN-II motor log, known by its header)\n"
      "  capstan-cli track --simulate --duration 200     (block transfer; add --distractors or "
      "--uneven-light)\n"
      "  capstan-cli track --simulate --occlude 40       (UKF paper, experiment D)\n"
      "  capstan-cli track --simulate --fail-motor 2@60  (motor 2's encoder freezes)");
  command->callback([arguments, command, &exit] { exit = track(*arguments, *command); });
}

}  // namespace capstan::cli
