#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Cameras registered with a turn",
    .what =
        "The registration of the cameras to the robot is turned, by a bumped tripod or a poor "
        "calibration: everything they see is turned about the origin of frame 0.",
    .equation = "p_c = R p, R the rotation by the vector (x, y, z) in frame 0",
    .source =
        "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
        "of the Optical Society of America A 4 (1987)",
    .changes = "Sensor: what the cameras see is turned about the origin of frame 0.",
    .signature =
        "In the cameras' channels straight lines against the tip's other coordinates, zero at "
        "the origin of frame 0; nothing in the joint encoders, and none of it depends on "
        "direction or speed.",
    .experiment = "Poses spread over the whole workspace, also far from the origin of frame 0.",
};

class CameraRotation final : public Hypothesis {
 public:
  CameraRotation() : Hypothesis("camera_rotation") {}
  Place place() const override { return Place::kSensor; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 0.0, 0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0, 0.0, 0.0}, {0.03, 0.03, 0.03}}});
  }
  double size(const std::vector<double>& v) const override { return amplitude(v, 3); }
};

}  // namespace

const Hypothesis& cameraRotation() {
  static const CameraRotation hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
