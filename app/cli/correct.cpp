#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/pose_motions.h"
#include "core/base/yaml.h"
#include "core/learning/model/correction_file.h"
#include "core/recording/pose_path.h"

namespace capstan::cli {
namespace {

struct CorrectArguments {
  std::string model, in, out;
};

ExitCode run(const CorrectArguments& arguments) {
  checkOutputs({{"OUT", arguments.out}}, {arguments.model, arguments.in});
  const learning::CorrectionFile file = learning::readCorrection(arguments.model);
  const recording::PosePaths paths = recording::readPosePaths(arguments.in);
  const std::vector<learning::State> wanted = recording::statesOf(paths);
  checkNear(file.model, wanted, arguments.in);
  const std::vector<learning::Corrected> corrected = file.model.correctSurely(wanted);
  const auto unsure = std::count_if(corrected.begin(), corrected.end(),
                                    [](const auto& one) { return one.confidence < learning::kUnsure; });
  base::writeTextFile(arguments.out, recording::formatCorrected(paths, corrected));
  if (!paths.timed) notice("The table has no t_s: every pose is corrected as one to rest at.");
  if (file.model.processes().empty())
    notice("The model is a rigid offset alone: it tells no confidence.");
  else if (unsure > 0)
    notice(
        fmt::format("{} of {} poses are far from what was learned (confidence below {}): they are corrected "
                    "by little more than the rigid offset.",
                    unsure, corrected.size(), learning::kUnsure));
  Output({}).text(fmt::format("{} poses corrected towards the {}.\n", corrected.size(),
                              base::nameOf(file.source.towards)));
  return kOk;
}

}  // namespace

void addCorrect(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<CorrectArguments>();
  CLI::App* command = app.add_subcommand("correct", "Correct poses by a model that `learn` wrote");
  command->add_option("--model", arguments->model, "file that `capstan-cli learn` wrote")->required();
  command
      ->add_option("IN", arguments->in,
                   "table of poses as they shall be seen: x, y, z [m], qx, qy, qz, qw; t_s, traj")
      ->required();
  command
      ->add_option("OUT", arguments->out, "table of what to ask for, with standard deviations and confidence")
      ->required();
  command->footer(
      "Velocities come from t_s; far from what was learned corrections fade to the rigid offset.\n"
      "Example: capstan-cli correct --model arm.correction wanted.csv commands.csv");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
