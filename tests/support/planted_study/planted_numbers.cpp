#include "tests/support/planted_study/planted_numbers.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/stats/interval.h"

namespace capstan::study {
namespace {

using test::Effect;
using test::Planted;

FoundNumber numberOf(const NamedCause& cause, std::string_view name) {
  for (const FoundNumber& number : cause.numbers)
    if (number.name == name) return number;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {std::string(name), nan, nan};
}

NumberCheck check(const NamedCause& cause, std::string_view name, double planted) {
  const FoundNumber found = numberOf(cause, name);
  return {std::string(name), planted, found.value, found.sigma};
}

/// √(sine² + cosine²), σ² = (sine² σ_s² + cosine² σ_c²) / amplitude².
NumberCheck checkAmplitude(const NamedCause& cause, double planted) {
  const FoundNumber sine = numberOf(cause, "sine"), cosine = numberOf(cause, "cosine");
  const double amplitude = std::hypot(sine.value, cosine.value);
  const double sigma = amplitude > 0.0
                           ? std::hypot(sine.value * sine.sigma, cosine.value * cosine.sigma) / amplitude
                           : std::max(sine.sigma, cosine.sigma);
  return {"amplitude", planted, amplitude, sigma};
}

/// The component along the planted axis.
NumberCheck checkComponent(const NamedCause& cause, const Planted& planted) {
  NumberCheck along{"along the axis", planted.magnitude, 0.0, 0.0};
  int axis = 0;
  for (const char* name : {"x", "y", "z"}) {
    const FoundNumber found = numberOf(cause, name);
    along.found += planted.axis(axis) * found.value;
    along.sigma = std::hypot(along.sigma, planted.axis(axis) * found.sigma);
    ++axis;
  }
  return along;
}

/// Of the planted effect and of the texture's part of the same kind on its joint.
std::complex<double> withTexture(const HiddenTruth& truth, const Planted& planted) {
  std::complex<double> sum = std::polar(1.0, planted.phase) * planted.magnitude;
  for (const Planted& one : truth.texture)
    if (one.effect == planted.effect && one.joint == planted.joint)
      sum += std::polar(1.0, one.phase) * one.magnitude;
  return sum;
}

NumberCheck checkCoupling(const NamedCause& cause, const Planted& planted) {
  NumberCheck added = check(cause, "added", planted.magnitude);
  if (std::lround(numberOf(cause, "other").value) != planted.other + 1)
    added.found = std::numeric_limits<double>::quiet_NaN();
  return added;
}

NumberCheck checkSlipTime(const NamedCause& cause, const Planted& planted, double duration) {
  NumberCheck time = check(cause, "time", planted.phase * duration);
  if (std::isfinite(time.found))
    time.planted = std::clamp(time.found, time.planted, time.planted + planted.signature);
  return time;
}

/// The one number of an effect whose magnitude stands for itself.
std::string_view ownNumber(Effect effect) {
  switch (effect) {
    case Effect::kHomingOffset:
      return "offset";
    case Effect::kCableCompliance:
      return "compliance";
    case Effect::kCableStiffening:
      return "cubic";
    case Effect::kBacklash:
      return "half_width";
    case Effect::kViscousFriction:
    case Effect::kInertia:
      return "added";
    case Effect::kPayload:
      return "mass";
    case Effect::kCameraLatency:
      return "delay";
    default:
      return "share";
  }
}

}  // namespace

bool NumberCheck::inside() const {
  const double rounding = 1e-9 * std::abs(planted);
  return std::abs(found - planted) <= std::max(stats::kNormal95 * sigma, rounding);
}

std::vector<NumberCheck> checkNumbers(const HiddenTruth& truth, std::size_t which, const NamedCause& cause) {
  const Planted& planted = truth.items.at(which).planted;
  const double m = planted.magnitude, s = planted.signature;
  switch (planted.effect) {
    case Effect::kCableCoupling:
      return {checkCoupling(cause, planted)};
    case Effect::kEncoderSlip:
      return {check(cause, "slip", m), checkSlipTime(cause, planted, truth.duration)};
    case Effect::kZeroDrift:
      return {check(cause, "drift", m), check(cause, "time_constant", s)};
    case Effect::kAsymmetricFriction:
      return {check(cause, "share", withTexture(truth, planted).real())};
    case Effect::kCableHysteresis:
      return {check(cause, "force", m), check(cause, "yield", s)};
    case Effect::kCableCreep:
      return {check(cause, "share", m), check(cause, "time_constant", s)};
    case Effect::kStribeckFriction:
      return {check(cause, "excess", m), check(cause, "speed", s)};
    case Effect::kSlack:
      return {check(cause, "pretension", s * (1.0 - m))};
    case Effect::kCapstanEccentricity:
      return {checkAmplitude(cause, std::abs(withTexture(truth, planted)))};
    case Effect::kPositionFriction:
      return {checkAmplitude(cause, std::abs(m)), check(cause, "period", s)};
    case Effect::kGravityTilt:
    case Effect::kCameraRotation:
    case Effect::kCameraOffset:
      return {checkComponent(cause, planted)};
    case Effect::kSensorSign:
      return {};
    default:
      return {check(cause, ownNumber(planted.effect), m)};
  }
}

}  // namespace capstan::study
