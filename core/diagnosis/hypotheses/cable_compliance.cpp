#include <numbers>

#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Cable softer than the model's",
    .what =
        "Something gives between motor and joint that the model takes for rigid, or for "
        "stiffer: cable terminations, idlers, their brackets, or the whole cable of a drive "
        "modelled without one.",
    .equation =
        "δ = δ_cable(γ) + compliance γ; in a rigid drive γ = δ / compliance, δ = r_mc q_m / N "
        "− r_l (q − q_hs), with motor and joint masses of their own",
    .source =
        "Spong, Modeling and control of elastic joint robots, Journal of Dynamic Systems, "
        "Measurement, and Control 109 (1987)",
    .changes =
        "Cable: a linear spring in series with the nominal cable. In a rigid drive motor and "
        "joint become two masses with a spring between them.",
    .signature =
        "In proportion to the torque at the joint, that of gravity, load and friction; in a "
        "rigid drive a ringing after every change of torque, and the more the faster the "
        "motion.",
    .experiment =
        "Press against the joint with a known load while the motor holds; in a rigid drive, "
        "steps of torque or a sweep of frequency over the resonance.",
};

constexpr double kAsRigid = 0.01;  // of the range: a stretch that makes no difference
constexpr double kLarge = 0.1;     // likewise, that makes a large one

/// In a cable drive linear in its number, from none of it on; what is large goes by the nominal stiffness,
/// and where that is as good as rigid by what the forces of the recording would show. In a rigid drive no
/// spring is an infinitely stiff one, so that starts have one, by resonance.
class CableCompliance final : public Hypothesis {
 public:
  CableCompliance() : Hypothesis("cable_compliance") {}
  Place place() const override { return Place::kCable; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    std::vector<EffectStart> all;
    if (s.stiffness > 0.0) {
      all.push_back({{0.0}, {1.0 / s.stiffness}});
      const double stretch = s.stretch + s.load / s.radius / s.stiffness;
      const double given = stretch / (s.radius * s.range);  // of the range, by the nominal cable
      if (given < kAsRigid) all.push_back({{0.0}, {kLarge / given / s.stiffness}});
      return usable(facts(), std::move(all));
    }
    for (const double resonance : {5.0, 10.0, 20.0}) {  // of the joint on the spring, the motor held [Hz]
      const double rate = 2.0 * std::numbers::pi * resonance;
      const double compliance = s.radius * s.radius / (s.inertia * rate * rate);
      all.push_back({{compliance}, {compliance}});
    }
    return usable(facts(), std::move(all));
  }
};

}  // namespace

const Hypothesis& cableCompliance() {
  static const CableCompliance hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
