#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/identify_drive.h"
#include "app/cli/identify_output.h"
#include "app/cli/identify_run.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "app/cli/simulation_arguments.h"
#include "core/base/same_recording.h"
#include "core/base/yaml.h"
#include "core/experiments/identified.h"
#include "core/recording/recording_kinds.h"

namespace capstan::cli {
namespace {

struct IdentifyArguments {
  std::vector<std::string> files;
  IdentifyMethods methods;
  std::string out, trace, tracking_out, read_as, json;
  bool simulate = false;
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
  if (!arguments.tracking_out.empty() && arguments.methods.exact_camera)
    refuseOption("--tracking-out", arguments.tracking_out,
                 "needs the camera's delay, which is taken as exact", "Leave --exact-camera out");
  if (!arguments.trace.empty() && arguments.methods.method == "batch")
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
  inputs.insert(inputs.end(), {arguments.methods.robot, arguments.methods.options});
  checkOutputs({{"--out", arguments.out},
                {"--trace", arguments.trace},
                {"--tracking-out", arguments.tracking_out},
                {"--json", arguments.json}},
               inputs);
}

/// Collects all recordings one after the other.
CollectedRecordings collectAll(IdentifyArguments& arguments, base::Progress& progress) {
  CollectedRecordings all;
  const std::string& robot = arguments.methods.robot;
  if (arguments.simulate) {
    arguments.simulation.robot = robot;
    all.add(*makeSimulation(arguments.simulation), {}, progress);
  }
  for (const std::string& file : arguments.files) {
    const RecordingFormat format = detectFormat(file);
    const auto source = openSource(file, format, format == RecordingFormat::kSession ? "" : robot,
                                   readAsOf(arguments.read_as));
    all.add(*source, file, progress);
  }
  return all;
}

/// Robot file of one joint, if it is given: its drive is identified from encoders and load, without cameras.
std::optional<robot::Description> driveOf(const IdentifyArguments& arguments, const CLI::App& command) {
  std::optional<robot::Description> robot;
  if (!arguments.methods.robot.empty() && !arguments.simulate)
    robot = robot::readDescriptionOrDefault(arguments.methods.robot);
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

/// Reads the recordings and runs the methods. Returns nothing if it was cancelled.
std::optional<Findings> find(IdentifyArguments& arguments) {
  base::Progress progress;
  const ProgressLine line(progress);
  return identifyCollected(collectAll(arguments, progress), arguments.methods, progress);
}

void writeReport(const IdentifyArguments& arguments, const Findings& found) {
  if (const std::string words = excludedWords(found); !words.empty()) notice(words);
  const auto& [set, dual, batch, choice] = *found.identified;
  const Output output(arguments.json);
  output.text(textOf(dual ? &*dual : nullptr, batch ? &*batch : nullptr, found.trueValues()));
  if (choice.method) output.text("\n" + identifiedParagraph(found.identified->estimates()));
  output.json(cli::documentOf(found));
  if (!arguments.trace.empty()) writeTrace(*dual, set, arguments.trace);
}

void writeRobot(const IdentifyArguments& arguments, const Findings& found) {
  std::vector<std::string> recordings;
  for (const std::string& file : arguments.files)
    recordings.push_back(std::filesystem::path(file).filename().string());
  if (arguments.simulate)
    recordings.push_back(fmt::format("a simulation (seed {})", arguments.simulation.seed));
  base::writeTextFile(arguments.out, identifiedRobotText(found, recordings));
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
    arguments.drive.robot = arguments.methods.robot;
    arguments.drive.read_as = readAsOf(arguments.read_as);
    arguments.drive.parameters = command.count("--parameters") > 0 ? arguments.methods.parameters : "all";
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
    base::writeTextFile(arguments.tracking_out, trackingOptionsText(*found));
  return kOk;
}

}  // namespace

void addIdentify(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<IdentifyArguments>();
  CLI::App* command = app.add_subcommand(
      "identify",
      "Find pulley radius, cable stiffness, cable damping and joint friction from recordings with cameras");
  command->add_option(
      "REC", arguments->files,
      "recordings of one robot and rig: session (.capstan) or " + recording::measuredTableKinds());
  command->add_option("--robot", arguments->methods.robot, "nominal robot file; a session contains its own");
  addReadAs(*command, arguments->read_as);
  command->add_option("--method", arguments->methods.method, "dual-ukf, batch, or both (with a comparison)")
      ->capture_default_str()
      ->check(CLI::IsMember({"dual-ukf", "batch", "both"}));
  command
      ->add_option("--parameters", arguments->methods.parameters,
                   "parameters to identify: r_l (pulley radius), k_e (cable stiffness), b_e (cable damping), "
                   "f_c (Coulomb\n"
                   "friction) of all joints, or r_l1, k_e2, … of one joint")
      ->capture_default_str();
  command->add_option("--options", arguments->methods.options,
                      "file of priors and goals (format: resources/identification/default.yaml)");
  command->add_flag("--exact-camera", arguments->methods.exact_camera,
                    "assume that registration and clock of the cameras are exact, as in the UKF paper");
  command->add_option("--threads", arguments->methods.threads, "number of worker threads of the batch method")
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
