#include "tests/support/planted/background_changes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::test {
namespace {

// Standard deviations as drawn by worn() and backgroundTexture() of an ordinary Ageing.
const double kFactor = std::log(2.0) / std::sqrt(12.0);  // of ln of a number between 0.7 and 1.4
const double kShift = 0.3 / std::sqrt(12.0);             // of the centre of mass, share of its arm
const double kTrace = std::sqrt(7e-4);                   // of a share between 0.01 and 0.04 of any sign
const double kEccentric = 0.64e-3;                       // of the capstan's radius
const double kStribeck = 0.012;                          // of an excess between 0.01 and 0.05

class Changes {
 public:
  Changes(const robot::Description& nominal, const robot::Description& worn, const Ageing& ageing)
      : nominal_(nominal), worn_(worn), ageing_(ageing) {}

  void addAgeing(std::size_t i, bool rigid) {
    addFactor(
        i, [](auto& joint, auto&) -> auto& { return joint.friction.coulomb; });
    addFactor(
        i, [](auto& joint, auto&) -> auto& { return joint.friction.viscous; });
    addFactor(
        i, [](auto& joint, auto&) -> auto& { return joint.link.mass; });
    changes_.back().robot.joints[i].link.inertia *= std::exp(kBackgroundStep * kFactor);
    for (int axis = 0; axis < 3; ++axis) addShift(i, axis);
    if (rigid) {
      addFactor(
          i, [](auto&, auto& drive) -> auto& { return drive.motor_friction.coulomb; });
      addFactor(
          i, [](auto&, auto& drive) -> auto& { return drive.motor_friction.viscous; });
    } else {
      addFactor(
          i, [](auto&, auto& drive) -> auto& { return drive.cable_stiffness; });
      addFactor(
          i, [](auto&, auto& drive) -> auto& { return drive.cable_damping; });
    }
  }

  void addTexture(int i, const PlantParameters& p) {
    Planted one;
    one.joint = i;
    one.effect = Effect::kAsymmetricFriction;
    one.magnitude = kBackgroundStep * kTrace;
    add(one, -0.04 * ageing_.texture / kTrace, 0.04 * ageing_.texture / kTrace);
    one.effect = Effect::kStribeckFriction;
    one.magnitude = kBackgroundStep * kStribeck;
    one.signature = 6.0 * p.smoothing[i];
    add(one, 0.0, 0.05 * ageing_.texture / kStribeck);
    if (p.rigid) return;
    one.effect = Effect::kCapstanEccentricity;
    const double sigma = kEccentric / std::numbers::sqrt2;  // of the sine, and of the cosine
    one.magnitude = kBackgroundStep * sigma * p.capstan[i];
    const double most = 1e-3 * ageing_.texture / sigma;
    add(one, -most, most);
    one.phase = 0.5 * std::numbers::pi;
    add(one, -most, most);
  }

  std::vector<BackgroundChange> take() { return std::move(changes_); }

 private:
  /// Between 0.7 and 1.4 times nominal.
  template <class Number>
  void addFactor(std::size_t i, Number&& number) {
    BackgroundChange change{worn_, {}, 0.0, 0.0};
    number(change.robot.joints[i], change.robot.drives[i]) *= std::exp(kBackgroundStep * kFactor);
    const double was = number(nominal_.joints[i], nominal_.drives[i]);
    const double is = number(worn_.joints[i], worn_.drives[i]);
    if (was > 0.0 && is > 0.0) {
      const double gone = std::log(is / was);
      change.low = std::min(0.0, (ageing_.wear * std::log(0.7) - gone) / kFactor);
      change.high = std::max(0.0, (ageing_.wear * std::log(1.4) - gone) / kFactor);
    }
    changes_.push_back(std::move(change));
  }

  /// At most 15 % of its distance from the joint, along each axis.
  void addShift(std::size_t i, int axis) {
    BackgroundChange change{worn_, {}, 0.0, 0.0};
    const Eigen::Vector3d& was = nominal_.joints[i].link.centre_of_mass;
    const Eigen::Vector3d& is = worn_.joints[i].link.centre_of_mass;
    const double arm = was.norm();
    change.robot.joints[i].link.centre_of_mass(axis) += kBackgroundStep * kShift * arm;
    if (arm > 0.0) {
      const double gone = (is(axis) - was(axis)) / arm;
      change.low = std::min(0.0, (-0.15 * ageing_.wear - gone) / kShift);
      change.high = std::max(0.0, (0.15 * ageing_.wear - gone) / kShift);
    }
    changes_.push_back(std::move(change));
  }

  void add(const Planted& texture, double low, double high) {
    changes_.push_back({worn_, {texture}, low, high});
  }

  const robot::Description& nominal_;
  const robot::Description& worn_;
  Ageing ageing_;
  std::vector<BackgroundChange> changes_;
};

}  // namespace

std::vector<BackgroundChange> backgroundChanges(const robot::Description& nominal,
                                                const robot::Description& worn, bool rigid,
                                                const Ageing& ageing) {
  Changes changes(nominal, worn, ageing);
  for (std::size_t i = 0; i < worn.joints.size(); ++i) changes.addAgeing(i, rigid);
  const PlantParameters parameters(worn, rigid);
  for (int i = 0; i < parameters.size; ++i) changes.addTexture(i, parameters);
  return changes.take();
}

}  // namespace capstan::test
