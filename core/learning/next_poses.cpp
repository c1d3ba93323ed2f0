#include "core/learning/next_poses.h"

#include <algorithm>
#include <numeric>

#include "core/learning/rotation_vector.h"

namespace capstan::learning {
namespace {

constexpr std::size_t kTried = 4;  // of the least sure, each time

double unsureness(const Eigen::VectorXd& confidence) { return 1.0 - confidence.mean(); }

/// The model after a visit in which it sees what it expects.
CorrectionModel visited(CorrectionModel model, State state) {
  state.pair.told = model.correct(state).pose;
  model.add({state});
  return model;
}

}  // namespace

std::vector<NextPose> nextPoses(const CorrectionModel& model, const std::vector<State>& candidates,
                                std::size_t count, base::Progress* progress) {
  std::vector<NextPose> chosen;
  CorrectionModel known = model;
  Eigen::VectorXd confidence = known.confidence(candidates);
  while (chosen.size() < std::min(count, candidates.size()) && !(progress && progress->cancelled())) {
    if (progress)
      progress->report(static_cast<double>(chosen.size()) / static_cast<double>(count), "choosing poses");
    std::vector<std::size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t tried = std::min(kTried, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(tried), order.end(),
                      [&](std::size_t a, std::size_t b) {
                        return confidence[static_cast<Eigen::Index>(a)] <
                               confidence[static_cast<Eigen::Index>(b)];
                      });
    NextPose best{0, unsureness(confidence), unsureness(confidence)};
    for (std::size_t k = 0; k < tried; ++k) {
      const double after = unsureness(visited(known, candidates[order[k]]).confidence(candidates));
      if (after < best.after) best = {order[k], best.before, after};
    }
    if (!(best.after < best.before)) break;
    known = visited(std::move(known), candidates[best.candidate]);
    confidence = known.confidence(candidates);
    chosen.push_back(best);
  }
  return chosen;
}

std::vector<State> posesWithin(const CorrectionModel& model, int each) {
  const CorrectionParts parts = model.parts();
  const Eigen::Isometry3d seen_from_told = parts.offset.inverse();
  std::vector<Eigen::Vector3d> turns = {Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {parts.turns.min()[axis], parts.turns.max()[axis]})
      turns.push_back(end * Eigen::Vector3d::Unit(axis));
  const auto place = [&](int step, int axis) {
    const double share = each > 1 ? static_cast<double>(step) / (each - 1) : 0.5;
    return parts.workspace.min()[axis] + share * parts.workspace.sizes()[axis];
  };
  std::vector<State> states;
  for (int k = 0; k < each * each * each; ++k)
    for (const Eigen::Vector3d& turn : turns) {
      Eigen::Isometry3d told = Eigen::Isometry3d::Identity();
      told.translation() =
          Eigen::Vector3d(place(k % each, 0), place(k / each % each, 1), place(k / each / each, 2));
      told.linear() = (parts.features.middle() * turnBy(turn)).toRotationMatrix();
      states.emplace_back();
      states.back().pair.seen = seen_from_told * told;
    }
  return states;
}

}  // namespace capstan::learning
