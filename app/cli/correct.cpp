#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/pose_motions.h"
#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/learning/model/correction_file.h"
#include "core/recording/pose_path.h"

namespace capstan::cli {
namespace {

struct CorrectArguments {
  std::string model, in, out;
  bool path = false, end_point = false;
};

/// Corrects each trajectory as a planned motion from its first waypoint to its last (--path, --end-point).
ExitCode correctPaths(const CorrectArguments& arguments) {
  const learning::CorrectionFile file = learning::readCorrection(arguments.model);
  const recording::PosePaths paths = recording::readPosePaths(arguments.in);
  checkNear(file.model, recording::statesOf(paths), arguments.in);
  learning::CommandCorrectionOptions options;
  options.mode =
      arguments.path ? learning::CorrectionMode::kFullTrajectory : learning::CorrectionMode::kEndPoint;
  std::vector<std::vector<learning::CorrectedWaypoint>> commands;
  std::size_t waypoints = 0, low_confidence = 0;
  for (const auto& motion : recording::plannedMotions(paths, arguments.in)) {
    commands.push_back(
        base::namingFile(arguments.in, [&] { return learning::correctedPath(file.model, motion, options); }));
    waypoints += commands.back().size();
    low_confidence += static_cast<std::size_t>(std::ranges::count_if(
        commands.back(), [](const auto& one) { return one.confidence < learning::kLowConfidence; }));
  }
  base::writeTextFile(arguments.out, recording::formatCommands(paths, commands));
  if (low_confidence > 0)
    notice(fmt::format("{} of {} waypoints are far from the learned poses (confidence below {}).",
                       low_confidence, waypoints, learning::kLowConfidence));
  Output({}).text(fmt::format("{} motions, {} waypoints corrected{} towards the {}.\n", commands.size(),
                              waypoints, arguments.path ? " each" : " by their end points",
                              base::nameOf(file.source.towards)));
  return kOk;
}

ExitCode run(const CorrectArguments& arguments) {
  checkOutputs({{"OUT", arguments.out}}, {arguments.model, arguments.in});
  if (arguments.path || arguments.end_point) return correctPaths(arguments);
  const learning::CorrectionFile file = learning::readCorrection(arguments.model);
  const recording::PosePaths paths = recording::readPosePaths(arguments.in);
  const std::vector<learning::State> desired = recording::statesOf(paths);
  checkNear(file.model, desired, arguments.in);
  const std::vector<learning::Corrected> corrected = file.model.correctWithConfidence(desired);
  const auto low_confidence = std::count_if(corrected.begin(), corrected.end(), [](const auto& one) {
    return one.confidence < learning::kLowConfidence;
  });
  base::writeTextFile(arguments.out, recording::formatCorrected(paths, corrected));
  if (!paths.timed) notice("The table has no t_s: every pose is corrected for an arm at rest.");
  if (file.model.processes().empty())
    notice("The model is only a rigid offset: it has no confidence.");
  else if (low_confidence > 0)
    notice(
        fmt::format("{} of {} poses are far from the learned poses (confidence below {}): they are corrected "
                    "by little more than the rigid offset.",
                    low_confidence, corrected.size(), learning::kLowConfidence));
  Output({}).text(fmt::format("{} poses corrected towards the {}.\n", corrected.size(),
                              base::nameOf(file.source.towards)));
  return kOk;
}

}  // namespace

void addCorrect(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<CorrectArguments>();
  CLI::App* command = app.add_subcommand("correct", "Correct desired poses with a model that `learn` wrote");
  command->add_option("--model", arguments->model, "file that `capstan-cli learn` wrote")->required();
  command
      ->add_option("IN", arguments->in,
                   "table of desired poses, in the cameras' frame: x, y, z [m], qx, qy, qz, qw; t_s, traj")
      ->required();
  command
      ->add_option("OUT", arguments->out,
                   "table of corrected commands to write, with standard deviations and confidence")
      ->required();
  command->add_flag(
      "--path", arguments->path,
      "trajectories are planned motions (t_s, traj): each waypoint is corrected with its velocity");
  command
      ->add_flag("--end-point", arguments->end_point,
                 "trajectories are straight motions: only their end points are corrected")
      ->excludes("--path");
  command->footer(
      "Velocities are computed from t_s. Far from the learned poses, corrections fade to the rigid offset.\n"
      "Examples:\n"
      "  capstan-cli correct --model arm.correction desired.csv commands.csv\n"
      "  capstan-cli correct --model arm.correction motions.csv commands.csv --path");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
