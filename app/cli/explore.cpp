#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/base/yaml.h"
#include "core/learning/next_poses.h"
#include "core/session/correction_file.h"
#include "core/session/pose_path.h"

namespace capstan::cli {
namespace {

struct ExploreArguments {
  std::string model, among, out;
  int count = 10;
};

/// What is asked for to visit them, in their order.
std::string visitsOf(const std::vector<learning::State>& candidates,
                     const std::vector<learning::NextPose>& next, const learning::CorrectionModel& model) {
  session::PosePaths paths;
  paths.paths.emplace_back();
  std::vector<learning::State> states;
  for (const learning::NextPose& visit : next) {
    states.push_back(candidates[visit.candidate]);
    paths.paths.back().poses.push_back({0, 0.0, states.back().pair.seen});
  }
  return session::formatCorrected(paths, model.correctSurely(states));
}

ExitCode run(const ExploreArguments& arguments) {
  constexpr int kEach = 4;
  checkOutputs({{"OUT", arguments.out}}, {arguments.model, arguments.among});
  const session::CorrectionFile file = session::readCorrection(arguments.model);
  if (file.model.processes().empty())
    refuseFile(arguments.model, "is a rigid offset alone: it is equally sure everywhere",
               "Learn a model with Gaussian processes (--method auto)");
  const std::vector<learning::State> candidates =
      arguments.among.empty() ? learning::posesWithin(file.model, kEach)
                              : session::statesOf(session::readPosePaths(arguments.among));
  base::Progress progress;
  std::vector<learning::NextPose> next;
  {
    const ProgressLine line(progress);
    next = learning::nextPoses(file.model, candidates, static_cast<std::size_t>(arguments.count), &progress);
  }
  if (progress.cancelled()) return kFailed;
  base::writeTextFile(arguments.out, visitsOf(candidates, next, file.model));
  if (next.empty()) {
    Output({}).text("No visit would make the model surer.\n");
    return kOk;
  }
  Output({}).text(fmt::format(
      "{} of {} poses to visit, the most worth while first: mean uncertainty {:.1f} % → {:.1f} %.\n",
      next.size(), candidates.size(), 100.0 * next.front().before, 100.0 * next.back().after));
  return kOk;
}

}  // namespace

void addExplore(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<ExploreArguments>();
  CLI::App* command =
      app.add_subcommand("explore", "Propose which poses to visit next for a surer correction");
  command->add_option("--model", arguments->model, "file that `capstan-cli learn` wrote")->required();
  command->add_option("--among", arguments->among,
                      "table of poses to choose from, as `correct` takes them; without it a grid over\n"
                      "the positions and turns that were learned");
  command->add_option("--count", arguments->count, "of visits")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command
      ->add_option(
          "OUT", arguments->out,
          "table of what to ask for, in the order of visits, with standard deviations and confidence")
      ->required();
  command->footer("Example: capstan-cli explore --model arm.correction --count 20 visits.csv");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
