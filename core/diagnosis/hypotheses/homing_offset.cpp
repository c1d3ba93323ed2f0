#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Hard stop elsewhere",
    .what =
        "The joint was homed at a position other than the one in the robot file, by a bent "
        "stop, a mounting error or homing that stopped early: every position is off by one "
        "constant.",
    .equation = "q = (q_hs + offset) + A⁻¹ (r_mc q_m / (N r_l)) without stretch",
    .source =
        "Mooring, Roth and Driels, Fundamentals of Manipulator Calibration (1991): joint "
        "offsets of the kinematic model",
    .changes = "Transmission: the position q_hs at the hard stop of this joint.",
    .signature =
        "A constant, at every position, direction and speed, moving or at rest; joints whose "
        "cables are coupled to this one are off by a constant, too. Cameras see it turned by "
        "the arm.",
    .experiment = "Any slow motion with rests; home anew in between and see whether the constant stays.",
};

class HomingOffset final : public Hypothesis {
 public:
  HomingOffset() : Hypothesis("homing_offset") {}
  Place place() const override { return Place::kTransmission; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    return usable(facts(), {{{0.0}, {0.02 * s.range}}});
  }
};

}  // namespace

const Hypothesis& homingOffset() {
  static const HomingOffset hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
