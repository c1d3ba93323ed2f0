#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Cameras with a wrong scale",
    .what =
        "The base line of the stereo cameras or the size of their calibration target is "
        "wrong: all that they see is larger or smaller, as seen from the origin of frame 0.",
    .equation = "p_c = (1 + share) p in frame 0",
    .source =
        "Horn, Closed-form solution of absolute orientation using unit quaternions, Journal "
        "of the Optical Society of America A 4 (1987)",
    .changes = "Sensor: what the cameras see is multiplied by 1 + share.",
    .signature =
        "In the cameras' channels a straight line against the tip's own coordinate, of one "
        "slope in all three; nothing in the joint encoders.",
    .experiment = "Poses near to and far from the origin of frame 0, in all directions.",
};

class CameraScale final : public Hypothesis {
 public:
  CameraScale() : Hypothesis("camera_scale") {}
  Place place() const override { return Place::kSensor; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.03}}});
  }
};

}  // namespace

const Hypothesis& cameraScale() {
  static const CameraScale hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
