#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/parts.h"

namespace capstan::diagnosis::library {
namespace {

constexpr HypothesisWords kWords{
    .title = "Load sensor without a sign",
    .what =
        "The sensor of the external load tells only how large it is, not to which side it "
        "pushes, as a rectifying amplifier or a cable-force sensor does.",
    .equation = "reading = |τ_ext|",
    .source =
        "Horowitz and Hill, The Art of Electronics (1989): the full-wave rectifier, or "
        "absolute-value circuit",
    .changes =
        "Sensor: the measured load enters with its magnitude, and with a sign that is told "
        "from the recording instead.",
    .signature =
        "Against the measured load two branches, mirrored: no remainder while the load pushes "
        "forwards, twice the load's effect while it pushes backwards.",
    .experiment = "Push the joint at rest by hand to one side, then to the other.",
};

class SensorSign final : public Hypothesis {
 public:
  SensorSign() : Hypothesis("sensor_sign") {}
  Place place() const override { return Place::kSensor; }
  const HypothesisWords& words() const override { return kWords; }
  std::vector<double> neutral() const override { return {0.0}; }
  std::vector<EffectStart> starts(const JointScales&, int) const override {
    return {{{1.0}, {0.0}}, {{-1.0}, {0.0}}};
  }
};

}  // namespace

const Hypothesis& sensorSign() {
  static const SensorSign hypothesis;
  return hypothesis;
}

}  // namespace capstan::diagnosis::library
