#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Cable that stiffens as it stretches",
    .what =
        "Strands of a wire rope settle and bear together, so that the cable is stiffer the "
        "more it is stretched, more than the nominal exponential law says.",
    .equation = "γ = 2 k_e sinh(a δ) + 2 k_e a cubic δ³",
    .source =
        "Kovacic and Brennan, The Duffing Equation (2011): odd power series of a symmetric "
        "spring to third order; nominal law Haghighipanah, Miyasaka, Li and Hannaford, "
        "Unscented Kalman filter and 3D vision to improve cable driven surgical robot joint "
        "angle estimation, ICRA 2016, (5) and (6)",
    .changes = "Cable: a cubic term beside the nominal force; small stretches feel nothing of it.",
    .signature =
        "Against the joint's torque or the stretch a curve that is flat in the middle and "
        "bends at both ends, away from the load: at high load the joint gives way less than "
        "simulated.",
    .experiment =
        "Loads up to the highest allowed, both ways, slowly; small loads alone do not show "
        "it.",
};

class CableStiffening final : public Hypothesis {
 public:
  CableStiffening() : Hypothesis("cable_stiffening") {}
  Place place() const override { return Place::kCable; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    return usable(facts(), {{{0.0}, {1.0 / (s.stretch * s.stretch)}}});
  }
};

}  // namespace

const Hypothesis& cableStiffening() {
  static const CableStiffening hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
