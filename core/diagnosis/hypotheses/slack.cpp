#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Lost pretension",
    .what =
        "The pair of cables has lost its pretension: beyond some stretch one of them sags and "
        "the other one is alone, half as stiff. If both are too long, there is a stretch in "
        "which neither pulls.",
    .equation =
        "γ = f(pretension + δ) − f(pretension − δ), f(x) = k_e a x for x > 0, else 0; damping "
        "where a cable is taut",
    .source =
        "Palli, Borghesan and Melchiorri, Modeling, identification, and control of "
        "tendon-based actuation systems, IEEE Transactions on Robotics 28 (2012): tendons "
        "pull only",
    .changes = "Cable: two cables that can only pull take the place of the nominal law.",
    .signature =
        "Against the joint's torque nothing in the middle and a straight line beyond a corner "
        "on either side: at high load the joint gives way more than simulated. With both "
        "cables too long two levels, as backlash has, and soft beyond.",
    .experiment =
        "Loads that rise slowly through the corner, both ways; small motions about rest for a "
        "pair that is too long.",
};

constexpr double kNone = 1e3;    // a pretension that no load uses up [m]
constexpr double kLeast = 1e-6;  // below it 1 / pretension goes on along its tangent [m]

/// Its size is 1 / pretension [1/m] less that of the neutral one: it rises as pretension falls, through 0
/// into what is too long.
class Slack final : public Hypothesis {
 public:
  Slack() : Hypothesis("slack") {}
  Place place() const override { return Place::kCable; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {kNone}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    std::vector<EffectStart> all;
    for (const double share : {0.6, 0.2, -0.3}) all.push_back({{share * s.stretch}, {0.3 * s.stretch}});
    return usable(facts(), std::move(all));
  }
  double size(const std::vector<double>& v) const override {
    const double p = v.at(0);
    if (p >= kNone) return 0.0;
    return p >= kLeast ? 1.0 / p - 1.0 / kNone : (2.0 - p / kLeast) / kLeast - 1.0 / kNone;
  }
};

}  // namespace

const Hypothesis& slack() {
  static const Slack hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
