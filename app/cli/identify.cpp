#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
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
#include "core/base/error.h"
#include "core/base/same_recording.h"
#include "core/base/software.h"
#include "core/base/yaml.h"
#include "core/experiments/identified.h"
#include "core/experiments/identify_recording.h"
#include "core/experiments/identify_trials.h"
#include "core/identification/identification_data.h"
#include "core/identification/options.h"
#include "core/recording/recording_kinds.h"
#include "core/tracking/source.h"

namespace capstan::cli {
namespace {

struct IdentifyArguments {
  std::vector<std::string> files;
  std::string robot, method = "both", parameters = identification::kDefaultParameters, options, out, trace,
                     tracking_out, read_as, json;
  int threads = 2;
  bool simulate = false, exact_camera = false;
  simulation::SimulationRequest simulation;
  IdentifyDriveArguments drive;  ///< arguments for a robot of one joint
};

void check(const IdentifyArguments& arguments, const CLI::App& command) {
  if (arguments.simulate && !arguments.files.empty())
    refuseOption("REC", arguments.files.front(), "is given together with --simulate", "Give one of them");
  if (!arguments.simulate && arguments.files.empty())
    refuseOption("REC", {}, "is missing", "Give one or more recordings, or --simulate");
  if (arguments.simulate && !arguments.read_as.empty())
    refuseOption(kReadAs, arguments.read_as, "is given together with --simulate", "Give one of them");
  if (!arguments.simulate && simulationAsked(command))
    refuseOption("--simulate", {}, "is missing, yet simulation options are given",
                 "Add --simulate or leave them out");
  if (!arguments.tracking_out.empty() && arguments.exact_camera)
    refuseOption("--tracking-out", arguments.tracking_out,
                 "needs the camera's delay, which is taken as exact", "Leave --exact-camera out");
  if (!arguments.trace.empty() && arguments.method == "batch")
    refuseOption("--trace", arguments.trace, "needs the dual UKF", "Choose --method dual-ukf or both");
}

/// Checks, before the long computation, that no recording is given twice and that outputs can be written and
/// are no inputs. Throws base::InputError.
void checkFiles(const IdentifyArguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (base::sameRecording(files[j], files[i]))
        refuseFile(files[i], "is the same recording as " + files[j] + ": it would count twice",
                   "Give each recording once");
  std::vector<std::string> inputs = withFilesOf(arguments.simulation, arguments.files);
  inputs.insert(inputs.end(), {arguments.robot, arguments.options});
  checkOutputs({{"--out", arguments.out},
                {"--trace", arguments.trace},
                {"--tracking-out", arguments.tracking_out},
                {"--json", arguments.json}},
               inputs);
}

/// Writes the tracking options of the recording, with `delay` [s] added to their camera_delay.
void writeTrackingOptions(tracking::TrackingOptions options, double delay, const std::string& path) {
  options.camera_delay += delay;
  base::writeTextFile(path, "# Tracking options with the camera's delay as identified (track --options).\n" +
                                base::writeYaml(options));
}

/// Collects all recordings one after the other. `truth` gets the text of the truth file of simulated ones,
/// `tracking` the tracking options of the first.
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
    const auto source = openSource(file, format, format == RecordingFormat::kSession ? "" : arguments.robot,
                                   readAsOf(arguments.read_as));
    auto data = identification::collect(*source, &progress);
    if (data.excluded > 0 && data.motors.size() == 0)
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

/// Robot file of one joint, if it is given: its drive is identified from encoders and load, without cameras.
std::optional<robot::Description> driveOf(const IdentifyArguments& arguments, const CLI::App& command) {
  std::optional<robot::Description> robot;
  if (!arguments.robot.empty() && !arguments.simulate)
    robot = robot::readDescriptionOrDefault(arguments.robot);
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

/// Results of the methods, and the data that they used.
struct Findings {
  std::string truth;  ///< text of the truth file; empty: not simulated
  tracking::TrackingOptions tracking;
  robot::Description recorded;  ///< nominal robot of the recording
  double duration = 0.0;        ///< duration of the motor samples [s]
  std::uint64_t excluded = 0, used = 0;
  std::optional<experiments::Identified> identified;

  double delay() const {
    const bool by_batch = *identified->choice.method == experiments::Method::kBatch;
    return (by_batch ? identified->batch->camera : identified->dual->camera).delay;
  }
};

void runMethods(const IdentifyArguments& arguments, const identification::IdentificationData& data,
                base::Progress& progress, Findings& found) {
  robot::Description nominal = data.robot;
  if (!arguments.robot.empty()) nominal = robot::readDescriptionOrDefault(arguments.robot);
  identification::IdentificationOptions options;
  if (!arguments.options.empty())
    options = base::readYamlFile<identification::IdentificationOptions>(arguments.options);
  if (arguments.exact_camera) options.camera = {0.0, 0.0, 0.0};
  std::optional<identification::ParameterSet> set;
  try {
    set.emplace(nominal, arguments.parameters, options.parameters);
  } catch (const base::InputError& error) {
    refuseOption("--parameters", error.fault().value, error.fault().reason, error.fault().remedy);
  }
  if (progress.cancelled()) return;
  found.identified = experiments::identifyRecording(data, *set,
                                                    {.dual = arguments.method != "batch",
                                                     .batch = arguments.method != "dual-ukf",
                                                     .camera = options.camera,
                                                     .threads = arguments.threads},
                                                    progress);
}

/// Reads the recordings and runs the methods. Returns nothing if it was cancelled.
std::optional<Findings> find(IdentifyArguments& arguments) {
  base::Progress progress;
  const ProgressLine line(progress);
  Findings found;
  const identification::IdentificationData data =
      collectAll(arguments, progress, found.truth, found.tracking);
  if (data.openCount() == 0 && !progress.cancelled())
    refuseOption("REC", data.title, "shows the marker nowhere",
                 "Give a recording in which cameras see the tip");
  found.excluded = data.excluded;
  found.used = data.motors.size();
  found.recorded = data.robot;
  found.duration = data.duration();
  runMethods(arguments, data, progress, found);
  if (progress.cancelled()) return std::nullopt;
  return found;
}

void writeReport(const IdentifyArguments& arguments, const Findings& found) {
  if (found.excluded > 0)
    notice(fmt::format("{} of {} motor samples excluded: an encoder had failed or gave no number",
                       found.excluded, found.excluded + found.used));
  const experiments::Identified& identified = *found.identified;
  const auto& dual = identified.dual;
  const auto& batch = identified.batch;
  const TrueValues truth = found.truth.empty()
                               ? TrueValues{}
                               : experiments::trueValues(found.truth, found.recorded, identified.set);
  const Output output(arguments.json);
  output.text(textOf(dual ? &*dual : nullptr, batch ? &*batch : nullptr, truth));
  nlohmann::json document = {{"motor_samples_excluded", found.excluded}};
  if (dual) document["dual_ukf"] = jsonOf(*dual, truth);
  if (batch) document["batch"] = jsonOf(*batch, truth);
  const auto& method = identified.choice.method;
  document["result"] = method ? nlohmann::json(base::nameOf(*method)) : nlohmann::json();
  output.json(document);
  if (!arguments.trace.empty()) writeTrace(*dual, identified.set, arguments.trace);
}

void writeRobot(const IdentifyArguments& arguments, const Findings& found) {
  experiments::RobotOrigin origin;
  for (const std::string& file : arguments.files)
    origin.recordings.push_back(std::filesystem::path(file).filename().string());
  if (arguments.simulate)
    origin.recordings.push_back(fmt::format("a simulation (seed {})", arguments.simulation.seed));
  origin.duration = found.duration;
  origin.method = base::nameOf(*found.identified->choice.method);
  origin.values = valueLines(found.identified->estimates());
  origin.software = base::software();
  base::writeTextFile(arguments.out, experiments::identifiedRobotText(found.identified->set.nominal(),
                                                                      found.identified->robot(), origin));
}

/// Prints a notice of the failure with the files that were not written. Returns kFailed.
ExitCode fail(const std::string& why, const IdentifyArguments& arguments) {
  std::string files;
  for (const std::string& file : {arguments.out, arguments.tracking_out})
    if (!file.empty()) files += (files.empty() ? "" : ", ") + file;
  notice(files.empty() ? why : why + "; not written: " + files);
  return kFailed;
}

ExitCode identify(IdentifyArguments& arguments, const CLI::App& command) {
  check(arguments, command);
  if (const auto drive = driveOf(arguments, command)) {
    arguments.drive.files = arguments.files;
    arguments.drive.robot = arguments.robot;
    arguments.drive.read_as = readAsOf(arguments.read_as);
    arguments.drive.parameters = command.count("--parameters") > 0 ? arguments.parameters : "all";
    arguments.drive.out = arguments.out;
    arguments.drive.json = arguments.json;
    return identifyDrive(arguments.drive, *drive);
  }
  checkFiles(arguments);
  const std::optional<Findings> found = find(arguments);
  if (!found) {
    notice("cancelled: nothing was identified");
    return kFailed;
  }
  writeReport(arguments, *found);
  const experiments::Choice& choice = found->identified->choice;
  if (!choice.method) return fail("nothing was identified: " + choice.words, arguments);
  if (!choice.words.empty()) notice(choice.words);
  if (!found->identified->anySeen()) return fail("no parameter is observable in this motion", arguments);
  if (!arguments.out.empty()) writeRobot(arguments, *found);
  if (!arguments.tracking_out.empty())
    writeTrackingOptions(found->tracking, found->delay(), arguments.tracking_out);
  return kOk;
}

}  // namespace

void addIdentify(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* command = app.add_subcommand(
      "identify", "Find pulley radius, cable stiffness and damping from a recording with cameras");
  command->add_option(
      "REC", arguments->files,
      "recordings of one robot and rig: session (.capstan) or " + recording::measuredTableKinds());
  command->add_option("--robot", arguments->robot, "nominal robot file; a session contains its own");
  addReadAs(*command, arguments->read_as);
  command->add_option("--method", arguments->method, "dual-ukf, batch, or both (with a comparison)")
      ->capture_default_str()
      ->check(CLI::IsMember({"dual-ukf", "batch", "both"}));
  command
      ->add_option("--parameters", arguments->parameters,
                   "parameters to identify: r_l (pulley radius), k_e (cable stiffness), b_e (cable damping), "
                   "f_c (Coulomb\n"
                   "friction) of all joints, or r_l1, k_e2, … of one joint")
      ->capture_default_str();
  command->add_option("--options", arguments->options,
                      "file of priors and goals (format: resources/identification/default.yaml)");
  command->add_flag("--exact-camera", arguments->exact_camera,
                    "assume that registration and clock of the cameras are exact, as in the UKF paper");
  command->add_option("--threads", arguments->threads, "number of worker threads of the batch method")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option(
      "--out", arguments->out,
      "identified robot file to write; result of the batch method if it found one, else of the dual UKF");
  command->add_option(
      "--tracking-out", arguments->tracking_out,
      "output: file of filter options that contains the identified delay of the camera, for track --options");
  command->add_option("--trace", arguments->trace,
                      "CSV file to write with the estimates of the dual UKF over time");
  command->add_option("--held-out", arguments->drive.held_out,
                      "robot of one joint: recordings for evaluation only");
  command
      ->add_option("--offsets", arguments->drive.offsets,
                   "robot of one joint: one encoder zero per file, or one shared zero")
      ->capture_default_str()
      ->check(CLI::IsMember({"file", "shared"}));
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  command->add_flag("--simulate", arguments->simulate,
                    "identify a simulated session, without a file in between");
  addSimulationOptions(*command, arguments->simulation);
  command->footer(
      "The observations are those of the cameras; joint encoders are not used. A robot of one joint is\n"
      "identified differently: the recording must contain the measured load, the joint encoder is the\n"
      "observation, and the parameters are r_l, k_c (stiffness of the unstretched cable), a (exponent of "
      "its\n"
      "law k_c sinh(a x) / a), b_e, f_c and f_v (Coulomb and viscous friction of the joint), tau_c and "
      "tau_v\n"
      "(the same of the motor).\n"
      "Examples:\n"
      "  capstan-cli identify trial.capstan --out my_robot.yaml\n"
      "  capstan-cli identify sinusoid.capstan --parameters r_l1 --method dual-ukf --trace r_l1.csv\n"
      "  capstan-cli track trial.capstan --estimator-robot my_robot.yaml\n"
      "  capstan-cli identify load0.csv load2.csv --held-out load1.csv --robot jaw.yaml --out my_jaw.yaml\n"
      "  capstan-cli identify --simulate --trajectory sinusoid --duration 200 --parameters r_l1");
  command->callback([arguments, command, &exit] { exit = identify(*arguments, *command); });
}

}  // namespace capstan::cli
