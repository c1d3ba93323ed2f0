#include "core/tracking/transmission_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/units.h"

namespace capstan::tracking {
namespace {

/// With a sign, and a real minus.
std::string signedText(double value, int digits) {
  const std::string text = fmt::format("{:+.{}f}", value, digits);
  return text.front() == '-' ? "−" + text.substr(1) : text;
}

bool camerasMoved(const TransmissionEstimate& found) { return found.camera_moved_probability > 0.5; }

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
  if (camerasMoved(found))
    lines.push_back(fmt::format("cameras moved since their registration: {:.2f}°, {:.1f} mm",
                                base::toDegrees(found.camera_rotation.norm()),
                                base::toMillimetres(found.camera_shift.norm())));
  return lines;
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
  if (camerasMoved(found)) parts.emplace_back("cameras moved");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace capstan::tracking
