#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Stiffness that goes with the position",
    .what =
        "The free length of the cable grows as the joint moves over its range, and a longer "
        "cable is softer.",
    .equation =
        "γ = 2 k_e sinh(a δ) / (1 + share x) + 2 b_e dδ/dt, x = −1 … 1 from the lower to the "
        "upper limit, |x| ≤ 1.2",
    .source =
        "Werkmeister and Slocum, Theoretical and experimental determination of capstan drive "
        "stiffness, Precision Engineering 31 (2007): stiffness E A / L of the free length L",
    .changes = "Cable: the stiffness of both cables of this joint, by its position.",
    .signature =
        "In proportion to the torque at the joint, with one sign near one end of the range "
        "and with the other near the other end.",
    .experiment = "The same load at both ends of the range and in the middle.",
};

class PositionStiffness final : public Hypothesis {
 public:
  PositionStiffness() : Hypothesis("position_stiffness") {}
  Place place() const override { return Place::kCable; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.4}}});
  }
};

}  // namespace

const Hypothesis& positionStiffness() {
  static const PositionStiffness hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
