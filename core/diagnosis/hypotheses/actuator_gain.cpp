#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Motor that gives more or less than asked for",
    .what =
        "The torque constant, the amplifier's gain or the gear ratio is not the nominal one, "
        "so that the torque at the joint is a multiple of the one recorded.",
    .equation = "M(q) ddq + C(q, dq) dq + G(q) + F(dq) = (1 + share) τ + τ_ext",
    .source =
        "Gautier and Briot, Global identification of joint drive gains and dynamic parameters "
        "of robots, Journal of Dynamic Systems, Measurement, and Control 136 (2014)",
    .changes =
        "Rigid body: the torque that drives this joint is multiplied by 1 + share; gravity "
        "and measured loads are not.",
    .signature =
        "In proportion to the motor torque. It shows only beside known weights or loads: "
        "otherwise inertia and friction take it up.",
    .experiment = "Move with and without a known load or payload; hold known weights at rest.",
};

class ActuatorGain final : public Hypothesis {
 public:
  ActuatorGain() : Hypothesis("actuator_gain") {}
  Place place() const override { return Place::kRigidBody; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.2}}});
  }
};

}  // namespace

const Hypothesis& actuatorGain() {
  static const ActuatorGain hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
