#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Eccentric motor capstan",
    .what =
        "The axis of the motor capstan is off the centre of its drum, or the drum is out of "
        "round: in each turn it takes up more cable on one side and less on the other.",
    .equation = "s_m = r_mc φ + cosine sin φ + sine (cos φ − 1), φ = q_m / N",
    .source =
        "Tuttle and Seering, A nonlinear model of a harmonic drive gear transmission, IEEE "
        "Transactions on Robotics and Automation 12 (1996): kinematic error by harmonics of "
        "the rotation; here the first, of a circle turning off its centre",
    .changes = "Transmission: cable travel and lever of the motor wave once a turn of the capstan.",
    .signature =
        "A sine against the capstan's angle modulo one turn, of one height at every speed and "
        "load.",
    .experiment = "Slow sweeps over many turns of the capstan, both ways.",
};

class CapstanEccentricity final : public Hypothesis {
 public:
  CapstanEccentricity() : Hypothesis("capstan_eccentricity") {}
  Place place() const override { return Place::kTransmission; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    return usable(facts(), {{{0.0, 0.0}, {0.05 * s.capstan, 0.05 * s.capstan}}});
  }
  double everyday(const JointScales& s) const override { return 1.1e-3 * s.capstan; }
  double size(const std::vector<double>& v) const override { return amplitude(v, 2); }
};

}  // namespace

const Hypothesis& capstanEccentricity() {
  static const CapstanEccentricity hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
