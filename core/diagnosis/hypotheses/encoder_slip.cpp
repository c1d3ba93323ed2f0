#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Motor encoder that has slipped",
    .what =
        "At one instant the motor encoder lost counts, or its disc or the capstan slipped on "
        "the shaft: from then on the reading falls short of the motor by a constant.",
    .equation = "reading = q_m − slip u(t − time), u a smooth step",
    .source =
        "Hinkley, Inference about the change-point in a sequence of random variables, "
        "Biometrika 57 (1970): a step of unknown size at an unknown time",
    .changes = "Sensor: from `time` on the motor stands further than its reading says, by slip.",
    .signature =
        "A step against time: one constant before it and another one after it, whatever the "
        "arm does.",
    .experiment =
        "Go back to the same pose again and again, with fast stretches in between; the hard "
        "stop is the best of poses.",
};

constexpr int kTimes = 12;           // equally far apart in the middle four fifths of the recording
constexpr double kTimeScale = 0.05;  // [s]

class EncoderSlip final : public Hypothesis {
 public:
  EncoderSlip() : Hypothesis("encoder_slip") {}
  Place place() const override { return Place::kSensor; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0, 0.0}; }
  std::vector<EffectStart> starts(const JointScales& s, int) const override {
    std::vector<EffectStart> all;
    for (int k = 0; k < kTimes; ++k) {
      const double share = 0.1 + 0.8 * k / (kTimes - 1);
      all.push_back(
          {{0.0, share * s.duration}, {0.01 * s.range * s.radius * s.gear / s.capstan, kTimeScale}});
    }
    return s.duration > 0.0 ? usable(facts(), std::move(all)) : std::vector<EffectStart>{};
  }
};

}  // namespace

const Hypothesis& encoderSlip() {
  static const EncoderSlip hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
