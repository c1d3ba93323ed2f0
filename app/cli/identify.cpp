#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/identify_drive.h"
#include "app/cli/identify_output.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "app/cli/simulation_arguments.h"
#include "core/experiments/identify_trials.h"
#include "core/identification/delay_passes.h"
#include "core/identification/identification_data.h"
#include "core/identification/options.h"
#include "core/session/source.h"

namespace capstan::cli {
namespace {

struct IdentifyArguments {
  std::vector<std::string> files;
  std::string robot, method = "both", parameters = identification::kDefaultParameters, options, out, trace,
                     tracking_out, json;
  int threads = 2;
  bool simulate = false, exact_camera = false;
  simulation::SimulationRequest simulation;
  IdentifyDriveArguments drive;  ///< of a robot of one joint
};

void check(const IdentifyArguments& arguments, const CLI::App& command) {
  if (arguments.simulate && !arguments.files.empty())
    refuseOption("REC", arguments.files.front(), "is given together with --simulate", "Give one of them");
  if (!arguments.simulate && arguments.files.empty())
    refuseOption("REC", {}, "is missing", "Give one or more recordings, or --simulate");
  if (!arguments.simulate && simulationAsked(command))
    refuseOption("--simulate", {}, "is missing, yet simulation options are given",
                 "Add --simulate or leave them out");
  if (!arguments.tracking_out.empty() && arguments.exact_camera)
    refuseOption("--tracking-out", arguments.tracking_out,
                 "needs the camera's delay, which is taken as exact", "Leave --exact-camera out");
  if (!arguments.trace.empty() && arguments.method == "batch")
    refuseOption("--trace", arguments.trace, "needs the dual UKF", "Choose --method dual-ukf or both");
}

/// Before the long computation: outputs that can be written and are no inputs.
void checkFiles(const IdentifyArguments& arguments) {
  std::vector<std::string> inputs = withFilesOf(arguments.simulation, arguments.files);
  inputs.insert(inputs.end(), {arguments.robot, arguments.options});
  checkOutputs({{"--out", arguments.out},
                {"--trace", arguments.trace},
                {"--tracking-out", arguments.tracking_out},
                {"--json", arguments.json}},
               inputs);
}

/// The tracking options of the recording, whose stamps are late by `delay` more than they said.
void writeTrackingOptions(tracking::TrackingOptions options, double delay, const std::string& path) {
  options.camera_delay += delay;
  base::writeTextFile(path, "# Tracking options with the camera's delay as identified (track --options).\n" +
                                base::writeYaml(options));
}

/// All recordings one behind the other, the text of the truth file where they are simulated, and the tracking
/// options of the first.
identification::IdentificationData collectAll(IdentifyArguments& arguments, base::Progress& progress,
                                              std::string& truth, tracking::TrackingOptions& tracking) {
  if (arguments.simulate) {
    arguments.simulation.robot = arguments.robot;
    const auto source = makeSimulation(arguments.simulation);
    truth = source->info().truth;
    tracking = tracking::trackingOptionsOf(source->info());
    return identification::collect(*source, &progress);
  }
  std::optional<identification::IdentificationData> all;
  for (const std::string& file : arguments.files) {
    const RecordingFormat format = detectFormat(file);
    const auto source = openSource(file, format, format == RecordingFormat::kSession ? "" : arguments.robot);
    auto data = identification::collect(*source, &progress);
    if (data.left_out > 0 && data.motors.size() == 0)
      refuseFile(file,
                 "has a motor encoder that failed from the beginning: nothing can be identified from it",
                 "Give a recording with all motor encoders");
    if (data.openCount() == 0)
      refuseFile(
          file, "shows the marker nowhere, or has no registration: nothing can be identified from it",
          "Register the cameras (capstan-cli track --register), or give a recording with tip positions");
    truth = source->info().truth;
    if (!all) tracking = tracking::trackingOptionsOf(source->info());
    if (all)
      identification::append(*all, data);
    else
      all = std::move(data);
  }
  return std::move(*all);
}

/// A robot of one joint has no cameras: its drive is identified from its encoders and its load.
std::optional<robot::Description> driveOf(const IdentifyArguments& arguments, const CLI::App& command) {
  std::optional<robot::Description> robot;
  if (!arguments.robot.empty() && !arguments.simulate) robot = readRobot(arguments.robot);
  const bool drive = robot && robot->size() == 1;
  for (const char* option : {"--held-out", "--offsets"})
    if (!drive && command.count(option) > 0)
      refuseOption(option, {}, "is for a robot of one joint",
                   "Give its robot file with --robot, or leave it out");
  for (const char* option : {"--method", "--options", "--exact-camera", "--trace", "--tracking-out"})
    if (drive && command.count(option) > 0)
      refuseOption(option, {}, "is for recordings with cameras, not for " + robot->name + " of one joint",
                   "Leave it out");
  if (!drive) robot.reset();
  return robot;
}

ExitCode identify(IdentifyArguments& arguments, const CLI::App& command) {
  check(arguments, command);
  if (const auto drive = driveOf(arguments, command)) {
    arguments.drive.files = arguments.files;
    arguments.drive.robot = arguments.robot;
    arguments.drive.parameters = command.count("--parameters") > 0 ? arguments.parameters : "all";
    arguments.drive.out = arguments.out;
    arguments.drive.json = arguments.json;
    return identifyDrive(arguments.drive, *drive);
  }
  checkFiles(arguments);
  const Output output(arguments.json);
  base::Progress progress;
  std::string truth_text;
  tracking::TrackingOptions tracking;
  std::optional<identification::DualUkfReport> dual;
  std::optional<identification::BatchReport> batch;
  std::optional<identification::ParameterSet> set;
  robot::Description recorded;  // the plant before its truth
  std::uint64_t left_out = 0, used = 0;
  {
    const ProgressLine line(progress);
    const identification::IdentificationData data = collectAll(arguments, progress, truth_text, tracking);
    left_out = data.left_out;
    used = data.motors.size();
    if (data.openCount() == 0 && !progress.cancelled())
      refuseOption("REC", data.title, "shows the marker nowhere",
                   "Give a recording in which cameras see the tip");
    recorded = data.robot;
    robot::Description nominal = data.robot;
    if (!arguments.robot.empty()) nominal = readRobot(arguments.robot);
    identification::IdentificationOptions options;
    if (!arguments.options.empty())
      options = base::readYamlFile<identification::IdentificationOptions>(arguments.options);
    set.emplace(nominal, arguments.parameters, options.parameters);
    identification::CameraPoseOptions& camera = options.camera;
    if (arguments.exact_camera) camera = {0.0, 0.0, 0.0};
    if (arguments.method != "batch" && !progress.cancelled())
      dual = identification::identifyDualUkfInPasses(data, *set, {.camera = camera}, &progress);
    if (arguments.method != "dual-ukf" && !progress.cancelled()) {
      identification::BatchOptions batch_options{.camera = camera,
                                                 .shooting = {.threads = arguments.threads}};
      if (dual)
        for (const auto& estimate : dual->estimates) batch_options.start.push_back(estimate.log);
      batch = identification::identifyBatchInPasses(data, *set, batch_options, &progress);
    }
  }
  if (progress.cancelled()) {
    notice("cancelled: nothing was identified");
    return kFailed;
  }
  if (left_out > 0)
    notice(fmt::format("{} of {} motor samples left out: an encoder had failed or gave no number", left_out,
                       left_out + used));
  const TrueValues truth =
      truth_text.empty() ? TrueValues{} : experiments::trueValues(truth_text, recorded, *set);
  output.text(textOf(dual ? &*dual : nullptr, batch ? &*batch : nullptr, truth));
  nlohmann::json document = {{"motor_samples_left_out", left_out}};
  if (dual) document["dual_ukf"] = jsonOf(*dual, truth);
  if (batch) document["batch"] = jsonOf(*batch, truth);
  output.json(document);
  if (!arguments.trace.empty()) writeTrace(*dual, *set, arguments.trace);
  const auto& estimates = batch ? batch->estimates : dual->estimates;
  if (!arguments.out.empty())
    writeIdentifiedRobot(set->nominal(), identification::identifiedRobot(*set, estimates), arguments.out);
  if (!arguments.tracking_out.empty())
    writeTrackingOptions(tracking, (batch ? batch->camera : dual->camera).delay, arguments.tracking_out);
  const bool any = std::any_of(estimates.begin(), estimates.end(), [](const auto& e) { return e.seen; });
  if (!any) notice("no parameter could be seen in this motion");
  return any ? kOk : kFailed;
}

}  // namespace

void addIdentify(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* command = app.add_subcommand(
      "identify", "Find pulley radius, cable stiffness and damping from a recording with cameras");
  command->add_option("REC", arguments->files,
                      "recordings of one robot and rig: session (.capstan) or measured table (.csv)");
  command->add_option("--robot", arguments->robot, "nominal robot file; a session brings its own");
  command->add_option("--method", arguments->method, "dual-ukf, batch, or both, compared")
      ->capture_default_str()
      ->check(CLI::IsMember({"dual-ukf", "batch", "both"}));
  command
      ->add_option("--parameters", arguments->parameters,
                   "of r_l1…3, k_e1…3, b_e1…3, f_c1…3; r_l, k_e, b_e, f_c mean all three joints")
      ->capture_default_str();
  command->add_option("--options", arguments->options,
                      "priors and goals (as resources/identification/default.yaml)");
  command->add_flag("--exact-camera", arguments->exact_camera,
                    "take registration and clock of the cameras as exact, as the UKF paper does");
  command->add_option("--threads", arguments->threads, "of the batch method")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("--out", arguments->out, "identified robot file; of the batch method where both ran");
  command->add_option("--tracking-out", arguments->tracking_out,
                      "options for track --options, with the camera's delay as identified");
  command->add_option("--trace", arguments->trace, "the dual UKF's estimates over time, as CSV");
  command->add_option("--held-out", arguments->drive.held_out,
                      "robot of one joint: recordings to judge the result by, not to identify from");
  command
      ->add_option("--offsets", arguments->drive.offsets,
                   "robot of one joint: encoder zeros, one a file or one shared")
      ->capture_default_str()
      ->check(CLI::IsMember({"file", "shared"}));
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  command->add_flag("--simulate", arguments->simulate,
                    "identify a simulated session, without a file in between");
  addSimulationOptions(*command, arguments->simulation);
  command->footer(
      "Cameras are the observation, joint encoders are never used. With a robot file of one joint, whose "
      "load\n"
      "was measured, the joint encoder is; parameters are then r_l, k_c, a, b_e, f_c, f_v, tau_c, tau_v.\n"
      "Examples:\n"
      "  capstan-cli identify trial.capstan --out my_robot.yaml\n"
      "  capstan-cli identify sinusoid.capstan --parameters r_l1 --method dual-ukf --trace r_l1.csv\n"
      "  capstan-cli track trial.capstan --estimator-robot my_robot.yaml\n"
      "  capstan-cli identify load0.csv load2.csv --held-out load1.csv --robot jaw.yaml --out my_jaw.yaml\n"
      "  capstan-cli identify --simulate --trajectory sinusoid --duration 200 --parameters r_l1");
  command->callback([arguments, command, &exit] { exit = identify(*arguments, *command); });
}

}  // namespace capstan::cli
