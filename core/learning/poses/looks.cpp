#include "core/learning/poses/looks.h"

#include <algorithm>

namespace capstan::learning {

std::size_t nextLook(const std::vector<CorrectedWaypoint>& path, std::size_t from,
                     const LookOptions& options) {
  const auto unsure = std::find_if(
      path.begin() + static_cast<std::ptrdiff_t>(from), path.end(),
      [&](const CorrectedWaypoint& waypoint) { return waypoint.confidence < options.least_confidence; });
  if (unsure == path.end()) return path.size() - 1;
  std::size_t next = std::max(static_cast<std::size_t>(unsure - path.begin()), from + 1) - 1;
  double way = 0.0;
  for (std::size_t k = from; k < path.size(); ++k) {
    if (k > from) way += (path[k].desired.translation() - path[k - 1].desired.translation()).norm();
    if (way >= options.piece || k + 1 == path.size()) return std::max(next, k);
  }
  return path.size() - 1;
}

Eigen::Isometry3d offsetSeen(const Eigen::Isometry3d& told, const Eigen::Isometry3d& seen) {
  return told * seen.inverse();
}

}  // namespace capstan::learning
