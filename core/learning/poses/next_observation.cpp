#include "core/learning/poses/next_observation.h"

#include <algorithm>

namespace capstan::learning {

std::size_t nextObservation(const std::vector<CorrectedWaypoint>& path, std::size_t from) {
  const auto low_confidence =
      std::find_if(path.begin() + static_cast<std::ptrdiff_t>(from), path.end(),
                   [](const CorrectedWaypoint& waypoint) { return waypoint.confidence < kLeastConfidence; });
  if (low_confidence == path.end()) return path.size() - 1;
  std::size_t next = std::max(static_cast<std::size_t>(low_confidence - path.begin()), from + 1) - 1;
  double way = 0.0;
  for (std::size_t k = from; k < path.size(); ++k) {
    if (k > from) way += (path[k].desired.translation() - path[k - 1].desired.translation()).norm();
    if (way >= kObservedPiece || k + 1 == path.size()) return std::max(next, k);
  }
  return path.size() - 1;
}

Eigen::Isometry3d offsetObserved(const Eigen::Isometry3d& commanded, const Eigen::Isometry3d& observed) {
  return commanded * observed.inverse();
}

}  // namespace capstan::learning
