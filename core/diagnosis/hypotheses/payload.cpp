#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Payload at the tip",
    .what =
        "The arm carries an instrument or weight that the robot file does not know, or lacks "
        "one that it has.",
    .equation = "M(q), C(q, dq), G(q) of the chain whose last link carries a point mass at the marker",
    .source =
        "Atkeson, An and Hollerbach, Estimation of inertial parameters of manipulator loads "
        "and links, International Journal of Robotics Research 5 (1986)",
    .changes = "Rigid body: mass, centre of mass and inertia of the last link.",
    .signature =
        "By the pose, as a heavier arm has it, the more the further it reaches out, and with "
        "acceleration: in all joints that lift the tip.",
    .experiment = "Rests with the arm stretched out and drawn in, then fast motion of the whole arm.",
};

class Payload final : public Hypothesis {
 public:
  Payload() : Hypothesis("payload") {}
  Place place() const override { return Place::kRigidBody; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.3}}});
  }
};

}  // namespace

const Hypothesis& payload() {
  static const Payload hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
