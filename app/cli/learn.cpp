#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/learn_output.h"
#include "app/cli/outputs.h"
#include "app/cli/pose_motions.h"
#include "core/base/same_recording.h"
#include "core/base/software.h"
#include "core/learning/model/correction_file.h"
#include "core/learning/model/correction_source.h"
#include "core/learning/poses/check_tables.h"
#include "core/recording/pose_table.h"

namespace capstan::cli {
namespace {

struct LearnArguments {
  std::vector<std::string> train, test;
  std::string method = "auto", towards = "command", kernel = "matern", onto, model, json;
  learning::LearningOptions options;
  double hold_out = 0.0;  ///< percent of the trajectories
  bool no_cleaning = false, no_weights = false, no_alignment = false;
};

void check(const LearnArguments& arguments) {
  for (const std::string& test : arguments.test)
    for (const std::string& train : arguments.train)
      if (base::sameRecording(train, test))
        refuseFile(test, "is also a training table: errors on it are no test", "Test on other trajectories");
}

learning::LearningReport learnOnto(const LearnArguments& arguments, learning::CorrectionFile old,
                                   base::Progress& progress) {
  checkProcesses(old.model, arguments.onto);
  checkNew(arguments.train, old.source);
  checkNew(arguments.test, old.source);
  return recording::namingTables(arguments.train, [&] {
    return learning::learnMore(std::move(old.model), old.source.clock_offset,
                               recording::readPoseTables(arguments.train), arguments.options, &progress);
  });
}

/// Errors on the test tables. The model is on disk already and stays there if the test fails.
TestReport testOf(const LearnArguments& arguments, const std::vector<learning::RawMotion>& tests,
                  const learning::LearningReport& report) {
  try {
    return testedOn(tests, report, arguments.options);
  } catch (const base::InputError&) {
    notice(fmt::format("The model is in {}, not tested:", arguments.model));
    throw;
  }
}

learning::LearningOptions optionsOf(const LearnArguments& arguments) {
  learning::LearningOptions options = arguments.options;
  options.towards =
      arguments.towards == "command" ? learning::StreamKind::kCommand : learning::StreamKind::kRobot;
  options.clean = !arguments.no_cleaning;
  options.weigh = !arguments.no_weights;
  options.align = !arguments.no_alignment;
  options.correction.fit.kernel = *base::fromName<learning::Kernel>(arguments.kernel);
  options.rigid = arguments.method == "offset";
  options.correction.motion = base::fromName<learning::Motion>(arguments.method);
  return options;
}

void checkFiles(const LearnArguments& arguments) {
  std::vector<std::string> inputs = arguments.train;
  inputs.push_back(arguments.onto);
  inputs.insert(inputs.end(), arguments.test.begin(), arguments.test.end());
  checkOutputs({{"--model", arguments.model}, {"--json", arguments.json}}, inputs);
}

learning::LearningReport learnAll(const LearnArguments& arguments,
                                  std::optional<learning::CorrectionFile> old) {
  base::Progress progress;
  const ProgressLine line(progress);
  if (old) return learnOnto(arguments, std::move(*old), progress);
  return recording::namingTables(arguments.train, [&] {
    return learning::learn(recording::readPoseTables(arguments.train, &progress), arguments.options,
                           &progress);
  });
}

/// Evaluation of --hold-out. The model is on disk already and stays there if the evaluation is cancelled.
std::optional<learning::HeldOutEvaluation> heldOutOf(const LearnArguments& arguments,
                                                     const learning::LearningReport& report) {
  if (arguments.hold_out == 0.0) return std::nullopt;
  base::Progress progress;
  const ProgressLine line(progress);
  const learning::HoldOut hold_out{arguments.hold_out / 100.0, arguments.options.correction.seed};
  auto evaluation = recording::namingTables(arguments.train, [&] {
    return learning::evaluateHeldOut(report.prepared, arguments.options, hold_out, &progress);
  });
  if (!evaluation.cancelled) return evaluation;
  notice(fmt::format("Cancelled: the model is in {}, not evaluated.", arguments.model));
  return std::nullopt;
}

ExitCode run(LearnArguments& arguments) {
  check(arguments);
  checkFiles(arguments);
  arguments.options = optionsOf(arguments);
  std::optional<learning::CorrectionFile> old;
  if (!arguments.onto.empty()) old = learning::readCorrection(arguments.onto);
  if (old) arguments.options.towards = old->source.towards;
  const std::vector<learning::RawMotion> tests = recording::readPoseTables(arguments.test);
  if (!tests.empty()) learning::checkTables(tests, arguments.options.towards);
  learning::CorrectionSource before = old ? old->source : learning::CorrectionSource{};
  LearnOutput found{learnAll(arguments, std::move(old)), {}, {}};
  if (found.report.cancelled) {
    notice("Cancelled: no model is written.");
    return kFailed;
  }
  learning::writeCorrection(
      {found.report.model, learning::correctionSource(arguments.train, arguments.options.towards,
                                                      found.report, base::software(), std::move(before))},
      arguments.model);
  if (!tests.empty()) found.test = testOf(arguments, tests, found.report);
  found.held_out = heldOutOf(arguments, found.report);
  const Output output(arguments.json);
  output.text(textOf(found) + fmt::format("The model is in {}.\n", arguments.model));
  output.json(jsonOf(found));
  return kOk;
}

}  // namespace

void addLearn(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<LearnArguments>();
  CLI::App* command = app.add_subcommand("learn", "Learn a correction of commands from tip poses");
  command
      ->add_option(
          "--train", arguments->train,
          "tables of tip poses (columns traj, t_cam_s, cam_x …, and the same columns for robot or cmd:\n"
          "t_robot_s, robot_x … or t_cmd_s, cmd_x …)")
      ->required();
  command->add_option("--test", arguments->test,
                      "tables of other trajectories, on which errors are measured");
  CLI::Option* hold_out =
      command
          ->add_option(
              "--hold-out", arguments->hold_out,
              "share of the training trajectories [%] held out for an evaluation: a model of the others is\n"
              "tested on them; the model that is written is learned from all")
          ->check(CLI::Range(1.0, 90.0));
  command
      ->add_option("--method", arguments->method,
                   "offset: rigid offset only. none, velocity and history add a Gaussian process, and say "
                   "which motion is\n"
                   "among its inputs: none (the pose alone), velocity, or history (velocity and the motion "
                   "of the last 1.6 s);\n"
                   "auto: velocity or history, whichever has the smaller error on held-out trajectories")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "offset", "none", "velocity", "history"}));
  command
      ->add_option("--towards", arguments->towards,
                   "poses that the observed poses are compared with: commanded poses, or poses from the "
                   "robot's kinematics\n"
                   "(`diagnose --towards` calls the latter kinematics)")
      ->capture_default_str()
      ->check(CLI::IsMember({"command", "robot"}));
  command->add_flag("--no-cleaning", arguments->no_cleaning,
                    "keep outliers, and give all states the same weight");
  command->add_flag("--no-weights", arguments->no_weights,
                    "give all inliers of cleaning the same weight, and readmit no rejected states");
  command
      ->add_option("--kernel", arguments->kernel,
                   "kernel of the processes: Matérn 3/2 (once differentiable) or squared exponential (RBF)")
      ->capture_default_str()
      ->check(CLI::IsMember({"rbf", "matern"}));
  command->add_flag("--no-alignment", arguments->no_alignment,
                    "use time stamps as they are, without a clock offset");
  command
      ->add_option(
          "--members", arguments->options.correction.members,
          "number of averaged processes, each trained on its own random states; one if a single process "
          "can take all states")
      ->capture_default_str()
      ->check(CLI::Range(1, 20));
  command
      ->add_option("--inducing", arguments->options.correction.inducing_points,
                   "number of inducing points of each member process")
      ->capture_default_str()
      ->check(CLI::Range(20, 20000));
  command->add_option("--threads", arguments->options.correction.threads, "number of worker threads")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("--seed", arguments->options.correction.seed, "random seed")->capture_default_str();
  command->add_option("--model", arguments->model, "file to write")->required();
  CLI::Option* onto = command->add_option(
      "--onto", arguments->onto,
      "existing model to add the training motions to, without retraining (takes a few seconds); its offset,\n"
      "kernels, inducing points, output scales and clock offset stay. It improves little in regions without\n"
      "earlier data. Motions that contradict the model are refused");
  for (const char* fixed : {"--method", "--towards", "--no-cleaning", "--no-weights", "--kernel",
                            "--no-alignment", "--members", "--inducing", "--threads", "--seed"})
    onto->excludes(command->get_option(fixed));
  onto->excludes(hold_out);
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  command->footer(
      "The output lists rows without a pose, rejected states with the reasons, and the clock offset.\n"
      "Examples:\n"
      "  capstan-cli learn --train monday.csv --test tuesday.csv --model arm.correction\n"
      "  capstan-cli learn --train monday.csv --towards robot --method velocity --model arm.correction "
      "--json -");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
