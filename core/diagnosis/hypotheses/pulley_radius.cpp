#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Pulley of another radius",
    .what =
        "The pulley that turns the joint is larger or smaller than the robot file says, by a "
        "worn groove, another cable diameter or a wrong drawing: a turn of the motor moves "
        "the joint less or more.",
    .equation =
        "s_l = r_l (1 + share) (A (q − q_hs)), hence q − q_hs is the nominal one / (1 + "
        "share)",
    .source =
        "Haghighipanah, Miyasaka, Li and Hannaford, Unscented Kalman filter and 3D vision to "
        "improve cable driven surgical robot joint angle estimation, ICRA 2016, (3) and (4): "
        "r_l is its most uncertain number",
    .changes = "Transmission: the link radius r_l of this joint is multiplied by 1 + share.",
    .signature =
        "A straight line against the joint's own position that is zero at the hard stop, the "
        "same in both directions of motion and at every speed.",
    .experiment =
        "Slow sweeps over the whole range without load; how far the joint travels matters, "
        "not how fast.",
};

class PulleyRadius final : public Hypothesis {
 public:
  PulleyRadius() : Hypothesis("pulley_radius") {}
  Place place() const override { return Place::kTransmission; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.05}}});
  }
};

}  // namespace

const Hypothesis& pulleyRadius() {
  static const PulleyRadius hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
