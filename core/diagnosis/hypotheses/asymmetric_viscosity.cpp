#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Viscous friction that differs between the directions",
    .what =
        "Grease and seals brake one way more than the other, or the losses of a screw or gear are others "
        "when "
        "the motor drives than when it brakes.",
    .equation = "F = F_c sgn v + F_v (1 + share sgn v) v, sgn v smoothed as tanh(v / v_eps)",
    .source =
        "Armstrong-Hélouvry, Control of Machines with Friction (1991), chapter 3: viscous "
        "friction identified for each direction of its own",
    .changes = "Friction: viscous friction is 1 + share of itself forwards and 1 − share backwards.",
    .signature =
        "Nothing in slow motion; in fast motion an error of one sign both ways that grows with "
        "speed.",
    .experiment = "Equal paths both ways at a low, a middle and the highest speed.",
};

class AsymmetricViscosity final : public Hypothesis {
 public:
  AsymmetricViscosity() : Hypothesis("asymmetric_viscosity") {}
  Place place() const override { return Place::kFriction; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.3}}});
  }
};

}  // namespace

const Hypothesis& asymmetricViscosity() {
  static const AsymmetricViscosity hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
