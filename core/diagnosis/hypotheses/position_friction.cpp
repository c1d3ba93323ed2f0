#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Friction that waves with the position",
    .what =
        "A bent shaft, an eccentric bearing or pulley or the teeth of a gear rub more at some "
        "positions than at others, and repeat after a period.",
    .equation = "F = F_c (1 + sine sin(2π q / period) + cosine cos(2π q / period)) sgn v + F_v v",
    .source =
        "Popović and Goldenberg, Modeling of friction using spectral analysis, IEEE "
        "Transactions on Robotics and Automation 14 (1998)",
    .changes = "Friction: Coulomb friction of this joint, by its position.",
    .signature = "A wave against the joint's position whose sign turns with the direction of motion.",
    .experiment = "Slow sweeps over the whole range both ways, at one speed and load.",
};

class PositionFriction final : public Hypothesis {
 public:
  PositionFriction() : Hypothesis("position_friction") {}
  Place place() const override { return Place::kFriction; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 0.0, 1.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    std::vector<EffectStart> all;
    for (const double share : {0.25, 0.4, 0.6, 0.9}) {
      const double period = share * s.range;
      all.push_back({{0.0, 0.0, period}, {0.5, 0.5, 0.15 * period}});
    }
    return s.range > 0.0 ? usable(facts(), std::move(all)) : std::vector<EffectStart>{};
  }
  double size(const std::vector<double>& v) const override { return amplitude(v, 2); }
};

}  // namespace

const Hypothesis& positionFriction() {
  static const PositionFriction hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
