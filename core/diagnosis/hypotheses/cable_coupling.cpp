#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Motion of another joint carried over by the cable",
    .what =
        "The cable of this joint runs over pulleys on the axis of another joint, whose motion "
        "winds it up by a share that the coupling matrix lacks or has wrong.",
    .equation = "s_l = r_l (A (q − q_hs)), A(joint, other) = nominal + added",
    .source =
        "Lee and Tsai, The structural synthesis of tendon-driven manipulators having a "
        "pseudotriangular structure matrix, International Journal of Robotics Research 10 "
        "(1991)",
    .changes =
        "Transmission: one number off the diagonal of the coupling matrix A; torques follow "
        "by its transpose.",
    .signature =
        "A straight line against the position of the other joint, also while this joint's "
        "motor stands still.",
    .experiment = "Hold this joint's motor and sweep each other joint alone over its range.",
};

/// A start for each other joint, which a fit keeps.
class CableCoupling final : public Hypothesis {
 public:
  CableCoupling() : Hypothesis("cable_coupling") {}
  Place place() const override { return Place::kTransmission; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 1.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int joint) const override {
    std::vector<EffectStart> all;
    for (int other = 1; other <= s.joints; ++other)
      if (other != joint) all.push_back({{0.0, static_cast<double>(other)}, {0.05, 0.0}});
    return usable(facts(), std::move(all));
  }
};

}  // namespace

const Hypothesis& cableCoupling() {
  static const CableCoupling hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
