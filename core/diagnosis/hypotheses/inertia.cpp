#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Inertia other than the model's",
    .what =
        "The joint is harder or easier to accelerate than its links account for: a rotor "
        "behind a gear, a counterweight or a pulley that the robot file lacks.",
    .equation = "(M(q) + added at the joint's place of the diagonal) ddq + C(q, dq) dq + G(q) = Γ",
    .source =
        "Siciliano, Sciavicco, Villani and Oriolo, Robotics: Modelling, Planning and Control "
        "(2009), inertia of rotors behind gears",
    .changes = "Rigid body: a constant on the diagonal of the mass matrix; gravity stays.",
    .signature = "In proportion to the joint's acceleration, nothing at constant speed and at rest.",
    .experiment = "Fast starts and stops, or a sine as high in frequency as the drive allows.",
};

class Inertia final : public Hypothesis {
 public:
  Inertia() : Hypothesis("inertia") {}
  Place place() const override { return Place::kRigidBody; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    return usable(facts(), {{{0.0}, {s.inertia}}});
  }
};

}  // namespace

const Hypothesis& inertia() {
  static const Inertia hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
