#include "core/learning/next_poses.h"

#include <algorithm>
#include <numeric>

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

}  // namespace capstan::learning
