#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Creeping cable",
    .what =
        "Under load the cable goes on stretching for seconds, and takes as long to recover, "
        "as polymer fibres and rope cores do.",
    .equation = "dx_c/dt = (share (δ − x_c) − x_c) / time_constant, γ = γ_nominal(δ − x_c)",
    .source =
        "Findley, Lai and Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials "
        "(1976): Kelvin–Voigt element in series with a spring",
    .changes = "Cable: a spring and damper in series with the nominal cable, with one state more.",
    .signature =
        "After a change of load an exponential against time; the remainder follows the torque "
        "with a lag, and at slow motion more than at fast.",
    .experiment = "Put a load on, hold still for several time constants, take it off and hold again.",
};

class CableCreep final : public Hypothesis {
 public:
  CableCreep() : Hypothesis("cable_creep") {}
  Place place() const override { return Place::kCable; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 1.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    std::vector<EffectStart> all;
    for (const double seconds : {0.5, 1.5, 5.0}) all.push_back({{0.5, seconds}, {0.5, 0.5 * seconds}});
    return usable(facts(), std::move(all));
  }
  bool remembers() const override { return true; }
};

}  // namespace

const Hypothesis& cableCreep() {
  static const CableCreep hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
