#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Viscous friction other than the model's",
    .what =
        "Grease, seals or eddy currents brake in proportion to speed, more or less than the "
        "robot file says.",
    .equation = "F = F_c sgn v + (F_v + added) v, sgn v smoothed as tanh(v / v_eps)",
    .source =
        "Siciliano, Sciavicco, Villani and Oriolo, Robotics: Modelling, Planning and Control "
        "(2009), joint friction torques",
    .changes = "Friction: the viscous friction F_v of this joint.",
    .signature =
        "A straight line against velocity through zero; in a rigid drive fast motions come "
        "out too large or too small, slow ones less so.",
    .experiment = "The same path at a low, a middle and the highest speed.",
};

class ViscousFriction final : public Hypothesis {
 public:
  ViscousFriction() : Hypothesis("viscous_friction") {}
  Place place() const override { return Place::kFriction; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    const double slope = s.coulomb > 0.0 ? 2.0 * s.coulomb / (0.3 * s.speed) : s.viscous;
    return usable(facts(), {{{0.0}, {slope}}});
  }
};

}  // namespace

const Hypothesis& viscousFriction() {
  static const ViscousFriction hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
