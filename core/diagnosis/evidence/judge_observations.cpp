#include <algorithm>
#include <cmath>

#include "core/diagnosis/evidence/channel_noise.h"
#include "core/diagnosis/evidence/recorded_tracks.h"
#include "core/robot/kinematics.h"
#include "core/robot/transmission.h"
#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

constexpr std::size_t kAbout = 3;         // observations on either side that the median is of
constexpr std::size_t kForCubic = 6;      // fewest observations for the cubic
constexpr double kFarthest = 8.0;         // deviation of an outlier, in spreads
constexpr double kNeverAnOutlier = 1e-3;  // deviation below which no observation is an outlier [m]

robot::JointVector vectorAt(const Columns& columns, double row) {
  robot::JointVector values(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    values(static_cast<Eigen::Index>(j)) = Evidence::at(columns[j], row);
  return values;
}

/// Tip by the kinematics of the measured joints, or else of the motors; the origin if neither is measured.
Eigen::Vector3d tipOfJoints(const Evidence& evidence, const robot::Chain& chain,
                            const robot::Transmission* transmission, double row) {
  if (evidence.hasEncoders()) {
    const robot::JointVector q = vectorAt(evidence.q, row);
    if (q.allFinite()) return chain.marker(q);
  }
  if (!transmission) return Eigen::Vector3d::Zero();
  return chain.marker(transmission->jointFromMotor(vectorAt(evidence.q_m, row)));
}

/// Value at observation i of the cubic through the two observations on either side (at the ends, through the
/// four nearest on one side).
double cubicAt(const std::vector<double>& d, std::size_t i) {
  const auto outside = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t e) {
    return 4.0 * (d[a] + d[c]) - 6.0 * d[b] - d[e];
  };
  if (i < 2) return outside(i + 1, i + 2, i + 3, i + 4);
  if (i + 2 >= d.size()) return outside(i - 1, i - 2, i - 3, i - 4);
  return (4.0 * (d[i - 1] + d[i + 1]) - d[i - 2] - d[i + 2]) / 6.0;
}

/// Deviation of each observation: the smaller of its distances from the median of the observations around it
/// and from the cubic through its neighbours. A smooth motion under a late camera deviates from the first
/// only.
std::vector<double> strayings(const std::vector<double>& d) {
  std::vector<double> result;
  for (std::size_t i = 0; i < d.size(); ++i) {
    const std::size_t begin = i - std::min(i, kAbout), end = std::min(d.size(), i + kAbout + 1);
    result.push_back(std::abs(d[i] - stats::median(std::span(d).subspan(begin, end - begin))));
    if (d.size() >= kForCubic) result.back() = std::min(result.back(), std::abs(d[i] - cubicAt(d, i)));
  }
  return result;
}

}  // namespace

void judgeObservations(Evidence& evidence, const robot::Description& robot) {
  const robot::Chain chain(robot);
  const bool motors = evidence.drive == DriveKind::kCable && !robot.drives.empty();
  const std::optional<robot::Transmission> transmission =
      motors ? std::optional<robot::Transmission>(robot) : std::nullopt;
  std::array<std::vector<double>, 3> distance;
  for (const TipObservation& observation : evidence.tip) {
    const Eigen::Vector3d d =
        observation.position -
        tipOfJoints(evidence, chain, transmission ? &*transmission : nullptr, observation.row);
    for (int axis = 0; axis < 3; ++axis) distance[static_cast<std::size_t>(axis)].push_back(d(axis));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    evidence.noise.tip[axis] = {0.0, whiteNoise(distance[axis])};
    const std::vector<double> away = strayings(distance[axis]);
    const double spread = std::max(evidence.noise.tip[axis].sigma, stats::median(away) / 0.6745);
    const double farthest = std::max(kNeverAnOutlier, kFarthest * spread);
    for (std::size_t i = 0; i < away.size(); ++i)
      if (away[i] > farthest) evidence.tip[i].counts = false;
  }
}

}  // namespace capstan::diagnosis
