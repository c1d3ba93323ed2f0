#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Hysteresis of the cable",
    .what =
        "Strands and sheaths rub on one another as the cable stretches: force follows stretch "
        "in a loop that does not depend on speed.",
    .equation = "γ = γ_nominal + force z / yield, dz/dt = dδ/dt − (|dδ/dt| z + dδ/dt |z|) / (2 yield)",
    .source =
        "Wen, Method for random vibration of hysteretic systems, Journal of the Engineering "
        "Mechanics Division, ASCE 102 (1976), with his n = 1, A = 1 and β = γ = 1 / (2 yield)",
    .changes = "Cable: a Bouc–Wen element beside the nominal cable, with one state more.",
    .signature =
        "A loop against stretch or torque that is as wide at low speed as at high; after a "
        "reversal the remainder turns over within the yield stretch.",
    .experiment = "The motor held, load and unload the joint slowly, in large and in small loops.",
};

class CableHysteresis final : public Hypothesis {
 public:
  CableHysteresis() : Hypothesis("cable_hysteresis") {}
  Place place() const override { return Place::kCable; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 1e-4}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    const double force = s.coulomb > 0.0 ? s.coulomb / s.radius : 0.1 * s.stiffness * s.stretch;
    std::vector<EffectStart> all;
    for (const double share : {0.1, 0.3, 0.8}) {
      const double yield = share * force / s.stiffness;
      all.push_back({{force, yield}, {force, 0.5 * yield}});
    }
    return usable(facts(), std::move(all));
  }
};

}  // namespace

const Hypothesis& cableHysteresis() {
  static const CableHysteresis hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
