#include "core/learning/poses/clean_states.h"

#include <algorithm>
#include <cmath>

namespace capstan::learning {
namespace {

Reason judged(const State& state, const CleaningReport& report) {
  const Eigen::Isometry3d observed = report.offset * state.pair.observed;
  const double rotation = Eigen::Quaterniond(observed.linear())
                              .angularDistance(Eigen::Quaterniond(state.pair.commanded.linear()));
  if (rotation > CleaningOptions::kMaxRotation) return Reason::kTooFarTurned;
  if (!report.workspace.contains(observed.translation())) return Reason::kOutside;
  if (state.velocity.head<3>().norm() > CleaningOptions::kMostSpeed) return Reason::kTooFast;
  if (state.velocity.tail<3>().norm() > CleaningOptions::kMaxRotationRate) return Reason::kTurnsTooFast;
  return Reason::kNone;
}

/// Rejects all states of trajectories whose share of misplaced states exceeds `most`.
void rejectTrajectories(const std::vector<State>& states, double most, std::vector<Reason>& reason) {
  for (std::size_t begin = 0, end = 0; begin < states.size(); begin = end) {
    std::size_t gone = 0;
    for (end = begin; end < states.size() && states[end].motion == states[begin].motion; ++end)
      gone += misplaced(reason[end]);
    if (static_cast<double>(gone) <= most * static_cast<double>(end - begin)) continue;
    for (std::size_t k = begin; k < end; ++k)
      if (reason[k] == Reason::kNone) reason[k] = Reason::kTrajectory;
  }
}

}  // namespace

bool misplaced(Reason reason) {
  return reason == Reason::kOutlier || reason == Reason::kTooFarTurned || reason == Reason::kOutside;
}

bool tooFast(const State& state) {
  return state.velocity.head<3>().norm() > CleaningOptions::kMostSpeed ||
         state.velocity.tail<3>().norm() > CleaningOptions::kMaxRotationRate;
}

std::size_t CleaningReport::count(Reason of) const {
  return static_cast<std::size_t>(std::count(reason.begin(), reason.end(), of));
}

CleaningReport cleanStates(const std::vector<State>& states, const CleaningOptions& options) {
  CleaningReport report;
  const std::vector<PosePair> pairs = pairsOf(states);
  for (const PosePair& pair : pairs) report.workspace.extend(pair.commanded.translation());
  const MedianReport median = leastMedianOffset(pairs, options.median);
  report.offset = median.offset;
  report.deviation = median.deviation;
  if (!states.empty()) {
    report.workspace.min().array() -= CleaningOptions::kMargin;
    report.workspace.max().array() += CleaningOptions::kMargin;
  }
  for (std::size_t k = 0; k < states.size(); ++k)
    report.reason.push_back(median.belongs[k] ? judged(states[k], report) : Reason::kOutlier);
  rejectTrajectories(states, options.most_rejected, report.reason);
  return report;
}

std::vector<Reason> judgedBy(const CleaningReport& found, const std::vector<State>& states,
                             const CleaningOptions& options) {
  std::vector<Reason> reason;
  const double most = std::pow(MedianOptions::kReach * found.deviation, 2);
  for (const State& state : states) {
    const bool belongs =
        squaredDistance(found.offset * state.pair.observed, state.pair.commanded, kLever) <= most;
    reason.push_back(belongs ? judged(state, found) : Reason::kOutlier);
  }
  rejectTrajectories(states, options.most_rejected, reason);
  return reason;
}

std::vector<State> kept(const std::vector<State>& states, const CleaningReport& report) {
  std::vector<State> some;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (report.reason[k] == Reason::kNone) some.push_back(states[k]);
  return some;
}

}  // namespace capstan::learning
