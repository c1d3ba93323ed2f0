#include "core/learning/evaluation/learning_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/learning/evaluation/held_out.h"

namespace capstan::learning {
namespace {

using learning::State;

std::vector<State> drawnShare(const std::vector<State>& states, double share, std::uint64_t seed) {
  const double desired = std::max(std::round(share * static_cast<double>(states.size())),
                                  static_cast<double>(learning::kFewestStates));
  std::vector<State> drawn;
  for (const Eigen::Index k : learning::drawnPoints(static_cast<Eigen::Index>(states.size()),
                                                    static_cast<Eigen::Index>(desired), seed))
    drawn.push_back(states[static_cast<std::size_t>(k)]);
  return drawn;
}

CorrectionErrors errorsOf(const std::vector<Eigen::Isometry3d>& poses, const std::vector<State>& test) {
  PoseErrors errors;
  for (std::size_t k = 0; k < test.size(); ++k) errors.add(poses[k], test[k].pair.commanded);
  return errors.summed();
}

std::vector<Eigen::Isometry3d> moved(const std::vector<State>& test, const Eigen::Isometry3d& by) {
  std::vector<Eigen::Isometry3d> poses;
  for (const State& state : test) poses.push_back(by * state.pair.observed);
  return poses;
}

}  // namespace

LearningCurve learningCurve(const std::vector<State>& states, const LearningCurveOptions& options,
                            base::Progress* progress) {
  LearningCurve curve;
  const std::vector<bool> held = heldOut(states, options.test_share, options.seed);
  curve.motions_held = static_cast<std::size_t>(std::count(held.begin(), held.end(), true));
  auto [train, test] = splitStates(states, held);
  const learning::CleaningReport cleaned = learning::cleanStates(train, options.cleaning);
  const std::vector<learning::Reason> reasons = learning::judgedBy(cleaned, test, options.cleaning);
  std::vector<State> clean;
  for (std::size_t k = 0; k < test.size(); ++k)
    if (reasons[k] == learning::Reason::kNone) clean.push_back(test[k]);
  train = learning::kept(train, cleaned);
  const std::vector<learning::PosePair> pairs = learning::pairsOf(train);
  curve.none = errorsOf(moved(clean, Eigen::Isometry3d::Identity()), clean);
  curve.offset = errorsOf(moved(clean, learning::rigidOffset(pairs)), clean);

  const auto count = static_cast<double>(options.shares.size());
  for (const double share : options.shares) {
    const std::vector<State> drawn = drawnShare(train, share, options.seed + 1);
    const double done = static_cast<double>(curve.points.size()) / count;
    const base::ProgressPart part{done, done + 1.0 / count, fmt::format("{} states", drawn.size())};
    const auto model = learning::CorrectionModel::trained(drawn, options.correction, progress, part);
    if (progress && progress->cancelled()) {
      curve.cancelled = true;
      return curve;
    }
    curve.points.push_back({share, drawn.size(), errorsOf(model.correct(clean), clean)});
  }
  return curve;
}

}  // namespace capstan::learning
