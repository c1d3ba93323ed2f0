#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Constant torque that the model does not know",
    .what =
        "The current amplifier or its sensor has an offset, a hose or a cable to the motor pulls, "
        "or a spring balances weight: something pushes the joint one way, moving or not.",
    .equation = "M(q) ddq + C(q, dq) dq + G(q) + F(dq) = τ + offset + τ_ext",
    .source =
        "Janot, Gautier and Brunot, Data set and reference models of EMPS, Workshop on nonlinear "
        "system identification benchmarks (2019), offset of the drive",
    .changes = "Rigid body: a constant torque or force is added at this joint.",
    .signature =
        "The same push in every position and direction, so that the simulation drifts away one way; "
        "at rest it shows as much as in motion.",
    .experiment = "Let the joint rest unheld in several places, then move slowly and evenly both ways.",
};

/// For rigid drives: a cable drive shows it as a stretch that a homing offset makes as well.
class TorqueOffset final : public Hypothesis {
 public:
  TorqueOffset() : Hypothesis("torque_offset") {}
  Place place() const override { return Place::kRigidBody; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    const double friction = s.coulomb > 0.0 ? s.coulomb : s.viscous * s.speed;
    return usable(facts(), {{{0.0}, {0.5 * friction}}});
  }
};

}  // namespace

const Hypothesis& torqueOffset() {
  static const TorqueOffset hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
