#include "core/tracking/transmission_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/shown_number.h"
#include "core/base/units.h"

namespace capstan::tracking {
namespace {

/// With a sign, and a real minus.
std::string signedText(double value, int digits) {
  return base::withMinus(fmt::format("{:+.{}f}", value, digits));
}

/// Smallest delay that is reported; exposures cause shorter ones.
constexpr double kDelayOfNote = 0.015;  // [s]
constexpr double kScaleOfNote = 0.01;

/// Ratio of the cable's k_e to that of the robot file.
double stiffnessRatio(const TransmissionEstimate& found, int joint) {
  return 1.0 / std::max(1.0 - found.compliance(joint), 1e-3);
}

bool delayed(const TransmissionEstimate& found) { return std::abs(found.camera_delay) > kDelayOfNote; }

/// The exposure is the stamp minus the field: late stamps (delay > 0) need a larger one.
std::string delayRemedy(double delay, DelayField field) {
  return fmt::format("The camera's time stamps are off: {} {} by {:.3f} s.", delay > 0.0 ? "raise" : "reduce",
                     field == DelayField::kLiveSetup ? "cameras.latency in the live set-up"
                                                     : "camera_delay in the filter options",
                     std::abs(delay));
}

std::string camerasText(const TransmissionEstimate& found) {
  std::string text = fmt::format("cameras moved since their registration: {:.2f}°, {:.1f} mm",
                                 base::toDegrees(found.camera_rotation.norm()),
                                 base::toMillimetres(found.camera_shift.norm()));
  if (std::abs(found.camera_scale) > kScaleOfNote)
    text +=
        fmt::format(", scale {} % (base line or focal length)", signedText(100.0 * found.camera_scale, 1));
  return text;
}

}  // namespace

std::vector<std::string> linesOf(const TransmissionEstimate& found) {
  std::vector<std::string> lines;
  for (int i = 0; i < 3; ++i) {
    if (found.includesScale(i))
      lines.push_back(fmt::format("joint {}: cable travel {} ± {:.2f} % of nominal (pulley radius)", i + 1,
                                  signedText(100.0 * found.scale(i), 2), 100.0 * found.scale_sigma(i)));
    if (found.includesOffset(i))
      lines.push_back(fmt::format("joint {}: cable zero {} ± {:.2f} mm off (homing)", i + 1,
                                  signedText(base::toMillimetres(found.offset(i)), 2),
                                  base::toMillimetres(found.offset_sigma(i))));
  }
  for (int i = 0; i < 3; ++i)
    if (found.includesCompliance(i))
      lines.push_back(fmt::format("joint {}: cable stiffness {:.2g} times that of the robot file", i + 1,
                                  stiffnessRatio(found, i)));
  if (found.camerasMoved()) lines.push_back(camerasText(found));
  if (delayed(found))
    lines.push_back(fmt::format("camera stamps {:.0f} ms {}", 1e3 * std::abs(found.camera_delay),
                                found.camera_delay > 0.0 ? "late" : "early"));
  if (found.change_in_question)
    lines.emplace_back("cameras and motors no longer agree: cameras were moved, or an encoder slipped");
  return lines;
}

std::vector<std::string> remediesOf(const TransmissionEstimate& found, DelayField delay_field) {
  bool constant = false, zero = false;
  for (int i = 0; i < 3; ++i) {
    constant |= found.includesScale(i) || found.includesCompliance(i);
    zero |= found.includesOffset(i);
  }
  std::vector<std::string> remedies;
  if (constant) remedies.emplace_back("A constant of the robot file is wrong: identify it.");
  if (zero)
    remedies.emplace_back(
        "A cable's zero is off, as after a wrong homing or an encoder that slipped: home the arm again.");
  if (found.camerasMoved())
    remedies.emplace_back("The cameras are not where they were registered: register them again.");
  if (delayed(found)) remedies.push_back(delayRemedy(found.camera_delay, delay_field));
  if (found.change_in_question)
    remedies.emplace_back(
        "If cameras were moved, register them again; if an encoder slipped, home the arm. Movement shows "
        "which.");
  return remedies;
}

std::string shortTextOf(const TransmissionEstimate& found) {
  std::vector<std::string> parts;
  for (int i = 0; i < 3; ++i) {
    if (found.includesScale(i))
      parts.push_back(fmt::format("q{} travel {} %", i + 1, signedText(100.0 * found.scale(i), 1)));
    if (found.includesOffset(i))
      parts.push_back(
          fmt::format("q{} zero {} mm", i + 1, signedText(base::toMillimetres(found.offset(i)), 1)));
  }
  for (int i = 0; i < 3; ++i)
    if (found.includesCompliance(i))
      parts.push_back(fmt::format("q{} stiffness ×{:.2g}", i + 1, stiffnessRatio(found, i)));
  if (found.camerasMoved()) parts.emplace_back("cameras moved");
  if (delayed(found))
    parts.push_back(fmt::format("stamps {:.0f} ms {}", 1e3 * std::abs(found.camera_delay),
                                found.camera_delay > 0.0 ? "late" : "early"));
  if (found.change_in_question) parts.emplace_back("cameras or encoders changed");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace capstan::tracking
