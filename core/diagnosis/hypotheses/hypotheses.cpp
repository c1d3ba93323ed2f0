#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/diagnosis/hypotheses/all.h"
#include "core/diagnosis/hypotheses/hypothesis.h"

namespace capstan::diagnosis {

Hypothesis::Hypothesis(std::string_view name) : facts_(robot::effectNamed(name)) {
  assert(facts_ != nullptr);
}

double Hypothesis::size(const std::vector<double>& values) const { return std::abs(values.at(0)); }

const std::vector<const Hypothesis*>& hypotheses() {
  using namespace library;
  static const std::vector<const Hypothesis*> all = {&pulleyRadius(),
                                                     &cableCoupling(),
                                                     &homingOffset(),
                                                     &encoderSlip(),
                                                     &capstanEccentricity(),
                                                     &cableCompliance(),
                                                     &cableStiffening(),
                                                     &positionStiffness(),
                                                     &backlash(),
                                                     &slack(),
                                                     &cableHysteresis(),
                                                     &cableCreep(),
                                                     &stribeckFriction(),
                                                     &asymmetricFriction(),
                                                     &asymmetricViscosity(),
                                                     &viscousFriction(),
                                                     &loadFriction(),
                                                     &positionFriction(),
                                                     &gravityTilt(),
                                                     &payload(),
                                                     &inertia(),
                                                     &actuatorGain(),
                                                     &torqueOffset(),
                                                     &cameraLatency(),
                                                     &cameraRotation(),
                                                     &cameraOffset(),
                                                     &cameraScale(),
                                                     &sensorSign()};
  return all;
}

const Hypothesis* hypothesisNamed(std::string_view name) {
  const auto& all = hypotheses();
  const auto found = std::ranges::find(all, name, &Hypothesis::name);
  return found == all.end() ? nullptr : *found;
}

}  // namespace capstan::diagnosis
