#include "core/registration/closure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace capstan::registration {
namespace {

double distance(const Eigen::Isometry3d& base_from_camera, const PointPair& pair) {
  return (base_from_camera * pair.camera - pair.base).norm();
}

}  // namespace

std::vector<Closure> closuresOf(const PairRegistration& fit, std::span<const CollectedPose> poses) {
  std::vector<Closure> closures;
  for (const CollectedPose& pose : poses)
    closures.push_back({distance(fit.base_from_camera, pose.pair),
                        std::hypot(sigmaAt(fit, pose.pair.camera), std::sqrt(3.0) * fit.sigma)});
  return closures;
}

std::vector<Closure> closuresOf(const Eigen::Isometry3d& base_from_camera,
                                std::span<const CollectedPose> poses) {
  std::vector<Closure> closures;
  for (const CollectedPose& pose : poses)
    closures.push_back({distance(base_from_camera, pose.pair), pose.camera_sigma});
  return closures;
}

std::string closureWords(std::span<const Closure> closures) {
  if (closures.empty()) return {};
  const auto ratio = [](const Closure& closure) { return closure.error / closure.sigma; };
  const Closure& worst = *std::ranges::max_element(closures, {}, ratio);
  if (worst.holds())
    return fmt::format("The registration holds: errors up to {:.2f} mm, {:.2f} mm RMS predicted",
                       base::toMillimetres(std::ranges::max(closures, {}, &Closure::error).error),
                       base::toMillimetres(worst.sigma));
  return fmt::format(
      "The registration does not hold: {:.2f} mm where {:.2f} mm RMS is predicted. Its rotation or the "
      "constants of the robot file are wrong, or another mark was detected",
      base::toMillimetres(worst.error), base::toMillimetres(worst.sigma));
}

}  // namespace capstan::registration
