#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Robot that stands tilted",
    .what =
        "The base is not mounted as the robot file says, so that gravity pulls in another "
        "direction of frame 0.",
    .equation = "G(q) of gravity R g_0, R the rotation by the vector (x, y, z) in frame 0",
    .source =
        "Craig, Introduction to Robotics: Mechanics and Control (1989): gravity as an "
        "acceleration of the base in the Newton–Euler recursion",
    .changes =
        "Rigid body: the direction of gravity in frame 0, for all joints at once. A turn "
        "about gravity itself changes nothing.",
    .signature =
        "By the pose, in all joints that bear weight, the same in both directions of motion "
        "and at rest: the difference of the two gravity torques, through the cables.",
    .experiment =
        "Rests in many poses of all joints, heavy links stretched out; measure the base with "
        "a spirit level.",
};

class GravityTilt final : public Hypothesis {
 public:
  GravityTilt() : Hypothesis("gravity_tilt") {}
  Place place() const override { return Place::kRigidBody; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 0.0, 0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0, 0.0, 0.0}, {0.15, 0.15, 0.15}}});
  }
  double size(const std::vector<double>& v) const override { return amplitude(v, 3); }
};

}  // namespace

const Hypothesis& gravityTilt() {
  static const GravityTilt hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
