#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Friction that grows with load",
    .what =
        "Bearings, gears and cables on their idlers rub more the more force goes through "
        "them: a share of the driving torque is lost.",
    .equation = "F = (F_c + share |Γ|) sgn v + F_v v, Γ the torque of the cable or motor at the joint",
    .source =
        "Hamon, Gautier and Garrec, Dynamic identification of robots with a dry friction "
        "model depending on load and velocity, IROS 2010",
    .changes =
        "Friction: Coulomb friction of this joint grows with the magnitude of the driving "
        "torque.",
    .signature =
        "A gap between the directions of motion that widens with the torque, whichever side "
        "the torque is on.",
    .experiment = "Slow motion both ways under no, middle and high load.",
};

class LoadFriction final : public Hypothesis {
 public:
  LoadFriction() : Hypothesis("load_friction") {}
  Place place() const override { return Place::kFriction; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.3}}});
  }
};

}  // namespace

const Hypothesis& loadFriction() {
  static const LoadFriction hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
