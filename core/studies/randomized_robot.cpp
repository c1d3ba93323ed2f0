#include "core/studies/randomized_robot.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace capstan::studies {

simulation::Truth drawRandomizedRobot(const simulation::Truth& centre, const Eigen::Vector3d& nominal_radius,
                                      const RandomizationSpread& spread, std::uint64_t seed) {
  base::Random random(seed, "world");
  const auto normal = [&](double sigma) { return sigma * std::clamp(random.normal(), -2.0, 2.0); };
  simulation::Truth sample = centre;
  for (int i = 0; i < 3; ++i) {
    simulation::JointTruth& joint = sample.joints[static_cast<std::size_t>(i)];
    joint.link_radius = joint.link_radius.value_or(nominal_radius(i)) * std::exp(normal(spread.link_radius));
    joint.stiffness_factor *= std::exp(normal(spread.stiffness));
    joint.damping_factor *= std::exp(normal(spread.damping));
    joint.hysteresis.stiffness *= std::exp(normal(spread.hysteresis));
    joint.stribeck.excess *= std::exp(normal(spread.stribeck));
    sample.cameras.rotation_error(i) = normal(spread.camera_rotation);
  }
  sample.cameras.stamp_delay = normal(spread.camera_delay);
  return sample;
}

}  // namespace capstan::studies
