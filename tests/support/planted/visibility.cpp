#include <algorithm>
#include <cmath>

#include "tests/support/planted/effect_sizes.h"

namespace capstan::test {

Visibility::Visibility(const robot::Description& nominal, const PlantParameters& parameters,
                       const std::vector<Planted>& texture, const SensorOptions& sensors,
                       PlantedMotion motion)
    : nominal_(nominal), parameters_(parameters), sensors_(sensors), recorded_(std::move(motion)) {
  plain_ = replayWith({});
  level_ = changeBy(texture);
  noise_.tip = StereoPair(Eigen::Vector3d::Zero(), sensors_).sigma();
  for (int i = 0; i < parameters_.size; ++i) {
    const bool turns = nominal_.joints[static_cast<std::size_t>(i)].type == robot::JointType::kRevolute;
    noise_.joints[i] = (turns ? sensors_.turn_count : sensors_.slide_count) / std::sqrt(12.0);
    level_.joints[i] = std::hypot(level_.joints[i], noise_.joints[i]);
  }
  level_.tip = std::hypot(level_.tip, noise_.tip);
}

PlantedMotion Visibility::replayWith(const std::vector<Planted>& effects) const {
  PlantParameters changed = parameters_;
  for (const Planted& e : effects) plantInParameters(e, nominal_, changed);
  Plant plant(changed, effects);
  return replay(plant, recorded_, effects);
}

Visibility::Change Visibility::changeBy(const std::vector<Planted>& effects) {
  Change change;
  if (effects.empty()) return change;
  const bool outside_the_arm = std::all_of(effects.begin(), effects.end(), [](const Planted& e) {
    return factsOf(e.effect).place == Place::kCamera || e.effect == Effect::kEncoderDrift;
  });
  const PlantedMotion changed = outside_the_arm ? plain_ : replayWith(effects);
  RigidChain chain(nominal_);
  const std::size_t rows = plain_.t.size();
  constexpr std::size_t kStride = 20;
  double count = 0.0;
  for (std::size_t k = 0; k < rows; k += kStride, count += 1.0) {
    for (int i = 0; i < parameters_.size; ++i) {
      const double moved = jointReading(changed, k, i, effects) - plain_.q[k][i];
      change.joints[i] += moved * moved;
    }
    change.tip += (cameraTip(changed, k, chain, nominal_.marker, effects) -
                   cameraTip(plain_, k, chain, nominal_.marker, {}))
                      .squaredNorm();
  }
  for (double& x : change.joints) x = std::sqrt(x / count);
  change.tip = std::sqrt(change.tip / count);
  return change;
}

double Visibility::of(const Planted& planted) {
  const Change change = changeBy({planted});
  const Place place = factsOf(planted.effect).place;
  const bool drifts = place != Place::kCamera && planted.effect != Effect::kEncoderDrift &&
                      planted.effect != Effect::kCableCompliance;
  const Change& level = parameters_.rigid && !drifts ? noise_ : level_;
  double most = sensors_.cameras ? change.tip / level.tip : 0.0;
  if (sensors_.joint_encoders)
    for (int i = 0; i < parameters_.size; ++i) most = std::max(most, change.joints[i] / level.joints[i]);
  return most;
}

}  // namespace capstan::test
