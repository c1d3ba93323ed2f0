#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/pose_motions.h"
#include "core/base/yaml.h"
#include "core/learning/model/correction_file.h"
#include "core/learning/model/next_poses.h"
#include "core/recording/pose_path.h"

namespace capstan::cli {
namespace {

struct ExploreArguments {
  std::string model, among, out;
  int count = 10;
};

/// Query poses and their commands, in the same order.
struct QueryPoses {
  recording::PosePaths paths;
  std::vector<learning::Corrected> corrected;
};

QueryPoses queryPosesOf(const std::vector<learning::State>& candidates,
                        const std::vector<learning::NextPose>& next, const learning::CorrectionModel& model) {
  QueryPoses queries;
  queries.paths.paths.emplace_back();
  std::vector<learning::State> states;
  for (const learning::NextPose& query : next) {
    states.push_back(candidates[query.candidate]);
    queries.paths.paths.back().poses.push_back({0, 0.0, states.back().pair.observed});
  }
  queries.corrected = model.correctWithConfidence(states);
  return queries;
}

std::string wordsOf(std::size_t candidates, const std::vector<learning::NextPose>& next,
                    const QueryPoses& queries) {
  std::string text = fmt::format(
      "{} of {} query poses, the most informative first. Uncertainty (mean variance of the correction over\n"
      "these poses, relative to the variance without data) before and after each pose is learned:\n",
      next.size(), candidates);
  for (std::size_t k = 0; k < next.size(); ++k)
    text += fmt::format("  pose {:3}   {:5.1f} % → {:5.1f} %\n", k + 1, 100.0 * next[k].before,
                        100.0 * next[k].after);
  const auto low_confidence = std::ranges::count_if(
      queries.corrected, [](const auto& one) { return one.confidence < learning::kLowConfidence; });
  return text + fmt::format(
                    "{} of them are corrected by little more than the rigid offset (confidence below\n"
                    "{}): go there with care.\n",
                    low_confidence, learning::kLowConfidence);
}

ExitCode run(const ExploreArguments& arguments) {
  constexpr int kEach = 4;
  checkOutputs({{"OUT", arguments.out}}, {arguments.model, arguments.among});
  const learning::CorrectionFile file = learning::readCorrection(arguments.model);
  if (file.model.processes().empty())
    refuseFile(arguments.model, "is a rigid offset alone: its confidence is the same everywhere",
               "Learn a model with Gaussian processes (--method auto)");
  const std::vector<learning::State> candidates =
      arguments.among.empty() ? learning::posesWithin(file.model, kEach)
                              : recording::statesOf(recording::readPosePaths(arguments.among));
  if (!arguments.among.empty()) checkNear(file.model, candidates, arguments.among);
  base::Progress progress;
  std::vector<learning::NextPose> next;
  {
    const ProgressLine line(progress);
    next = learning::nextPoses(file.model, candidates, static_cast<std::size_t>(arguments.count), &progress);
  }
  if (progress.cancelled()) return kFailed;
  const QueryPoses queries = queryPosesOf(candidates, next, file.model);
  base::writeTextFile(arguments.out, recording::formatCorrected(queries.paths, queries.corrected));
  if (next.empty()) {
    Output({}).text("No query pose would lower the model's uncertainty.\n");
    return kOk;
  }
  Output({}).text(wordsOf(candidates.size(), next, queries));
  return kOk;
}

}  // namespace

void addExplore(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<ExploreArguments>();
  CLI::App* command =
      app.add_subcommand("explore", "Propose the query poses that lower a correction's uncertainty most");
  command->add_option("--model", arguments->model, "file that `capstan-cli learn` wrote")->required();
  command->add_option("--among", arguments->among,
                      "table of poses to choose from, in the format of `correct`; default: a grid near\n"
                      "the learned positions and rotations");
  command->add_option("--count", arguments->count, "number of query poses")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command
      ->add_option(
          "OUT", arguments->out,
          "output table: proposed poses as commands, best first, with standard deviations and confidence")
      ->required();
  command->footer(
      "The printed uncertainty after each pose is that of a model retrained on all old and new motions;\n"
      "a model that is extended with `learn --onto` improves less.\n"
      "Example: capstan-cli explore --model arm.correction --count 20 queries.csv");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
