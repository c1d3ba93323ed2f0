#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Cameras late by their stamps",
    .what =
        "Exposure, transfer and a clock of their own make the cameras' time stamps late (or "
        "early) by a constant: they show where the tip was a moment ago.",
    .equation = "p_c(t) = p(t − delay)",
    .source =
        "Furgale, Rehder and Siegwart, Unified temporal and spatial calibration for "
        "multi-sensor systems, IROS 2013",
    .changes = "Clock: the instant at which the tip is compared with what the cameras saw.",
    .signature =
        "In proportion to the tip's velocity in the cameras' channels, nothing at rest and "
        "nothing in the joint encoders.",
    .experiment = "Fast motion back and forth along one axis; rests between.",
};

class CameraLatency final : public Hypothesis {
 public:
  CameraLatency() : Hypothesis("camera_latency") {}
  Place place() const override { return Place::kClock; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return usable(facts(), {{{0.0}, {0.05}}});
  }
};

}  // namespace

const Hypothesis& cameraLatency() {
  static const CameraLatency hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
