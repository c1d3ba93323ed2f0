#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Cameras registered with an offset",
    .what =
        "The registration of the cameras to the robot is shifted, or the marker sits "
        "elsewhere on the tool than the robot file says.",
    .equation = "p_c = p + (x, y, z) in frame 0",
    .source =
        "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
        "of the Optical Society of America A 4 (1987)",
    .changes = "Sensor: a constant is added to what the cameras see.",
    .signature =
        "A constant in each of the cameras' channels, whatever the arm does; nothing in the "
        "joint encoders.",
    .experiment =
        "Poses spread over the workspace that turn the tool: a shift of the marker turns with "
        "it, one of the cameras does not.",
};

class CameraOffset final : public Hypothesis {
 public:
  CameraOffset() : Hypothesis("camera_offset") {}
  Place place() const override { return Place::kSensor; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 0.0, 0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0, 0.0, 0.0}, {0.005, 0.005, 0.005}}});
  }
  double size(const std::vector<double>& v) const override { return amplitude(v, 3); }
};

}  // namespace

const Hypothesis& cameraOffset() {
  static const CameraOffset hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
