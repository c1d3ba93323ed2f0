#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Friction that differs between the directions",
    .what =
        "The joint rubs more one way than the other, by a one-sided seal, a worn tooth flank "
        "or a cable that climbs out of its groove.",
    .equation = "F = F_c (1 + share sgn v) sgn v + F_v v, sgn v smoothed as tanh(v / v_eps)",
    .source =
        "Armstrong-Hélouvry, Dupont and Canudas de Wit, A survey of models, analysis tools "
        "and compensation methods for the control of machines with friction, Automatica 30 "
        "(1994)",
    .changes = "Friction: Coulomb friction is 1 + share of itself forwards and 1 − share backwards.",
    .signature =
        "Against the direction of motion the same level both ways and another one at rest: it "
        "acts like a constant force that is there only while the joint moves. In a rigid "
        "drive one direction is too fast, the other too slow.",
    .experiment =
        "Equal slow motions both ways with rests in between; the rests tell it from an "
        "offset.",
};

class AsymmetricFriction final : public Hypothesis {
 public:
  AsymmetricFriction() : Hypothesis("asymmetric_friction") {}
  Place place() const override { return Place::kFriction; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.5}}});
  }
  double everyday(const JointScales&) const override { return 0.045; }
};

}  // namespace

const Hypothesis& asymmetricFriction() {
  static const AsymmetricFriction hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
