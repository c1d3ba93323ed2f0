#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Backlash",
    .what =
        "There is play between motor and joint, in the gear, a key or a cable end: when the "
        "force changes sides, the motor crosses the play before it moves the joint.",
    .equation =
        "γ = 2 k_e sinh(a (|δ| − half_width)₊ sgn δ) + 2 b_e dδ/dt, 0 within the play; it "
        "presses and never pulls",
    .source =
        "Nordin and Gutman, Controlling mechanical systems with backlash: a survey, "
        "Automatica 38 (2002)",
    .changes =
        "Cable: no force while the stretch is within ± half_width, and the nominal law beyond "
        "it.",
    .signature =
        "Two levels, half_width / r_l apart from the middle, one for each side of the force: "
        "against the direction of motion where friction is the force, against the sign of the "
        "torque where gravity or load is. Steps at reversals.",
    .experiment =
        "Slow reversals with little load, where friction changes the side; then the same "
        "against a constant load, under which the steps disappear.",
};

class Backlash final : public Hypothesis {
 public:
  Backlash() : Hypothesis("backlash") {}
  Place place() const override { return Place::kCable; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    std::vector<EffectStart> all;
    for (const double share : {0.3, 1.0}) all.push_back({{share * s.stretch}, {0.3 * s.stretch}});
    return usable(facts(), std::move(all));
  }
};

}  // namespace

const Hypothesis& backlash() {
  static const Backlash hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
