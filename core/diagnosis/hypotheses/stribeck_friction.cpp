#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Friction that is higher at low speed",
    .what =
        "Near standstill the lubricant film breaks down and friction exceeds Coulomb's; as "
        "speed rises it falls to it. The joint sticks and jumps.",
    .equation =
        "F = F_c (1 + excess exp(−(v / speed)²)) sgn v + F_v v, sgn v smoothed as tanh(v / "
        "v_eps)",
    .source =
        "Armstrong-Hélouvry, Dupont and Canudas de Wit, A survey of models, analysis tools "
        "and compensation methods for the control of machines with friction, Automatica 30 "
        "(1994)",
    .changes = "Friction: the Coulomb friction of this joint, by its speed.",
    .signature =
        "Against velocity a pair of peaks of opposite sign beside zero and nothing at high "
        "speed; steps where the motion starts.",
    .experiment =
        "Very slow motion and many reversals; constant speeds from a hundredth of the highest "
        "on.",
};

class StribeckFriction final : public Hypothesis {
 public:
  StribeckFriction() : Hypothesis("stribeck_friction") {}
  Place place() const override { return Place::kFriction; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 1.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    std::vector<EffectStart> all;
    for (const double share : {0.015, 0.04, 0.1})
      all.push_back({{1.0, share * s.speed}, {1.0, 0.5 * share * s.speed}});
    return usable(facts(), std::move(all));
  }
  double everyday(const JointScales&) const override { return 0.06; }
};

}  // namespace

const Hypothesis& stribeckFriction() {
  static const StribeckFriction hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
