#include "core/base/shown_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/units.h"

namespace capstan::base {
namespace {

struct Known {
  std::string_view si;
  double scale;
  std::string_view unit;
};
constexpr std::array kKnown = {Known{"rad", toDegrees(1.0), "deg"},
                               Known{"m", toMillimetres(1.0), "mm"},
                               Known{"rad/s", toDegrees(1.0), "deg/s"},
                               Known{"m/s", toMillimetres(1.0), "mm/s"},
                               Known{"rad/s^2", toDegrees(1.0), "deg/s²"},
                               Known{"m/s^2", toMillimetres(1.0), "mm/s²"},
                               Known{"m/N", 1e6, "µm/N"},
                               Known{"m/rad", toMillimetres(1.0), "mm/rad"}};

void replaceAll(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// Number with fixed decimals, or with a power of ten if it is large or needs too many decimals.
std::string number(double value, int decimals) {
  constexpr int kMost = 6;
  constexpr double kFar = 1e6;
  const bool far = std::abs(value) >= kFar || decimals > kMost;
  std::string text =
      far ? fmt::format("{:.2e}", value) : fmt::format("{:.{}f}", value, std::max(decimals, 0));
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);  // −0
  return withMinus(std::move(text));
}

}  // namespace

ShownUnit shownUnit(std::string_view si) {
  const auto known = std::ranges::find(kKnown, si, &Known::si);
  if (known != kKnown.end()) return {known->scale, std::string(known->unit)};
  std::string unit(si);
  replaceAll(unit, "*", "·");
  replaceAll(unit, "^2", "²");
  return {1.0, unit};
}

std::string shownNumber(double value, double sigma, const ShownUnit& unit) {
  value *= unit.scale;
  sigma *= unit.scale;
  const std::string after = unit.unit.empty() ? std::string() : " " + unit.unit;
  if (!std::isfinite(value)) return "unknown";
  if (!std::isfinite(sigma) || sigma <= 0.0) return number(value, significantDecimals(value, 3)) + after;
  const int decimals = significantDecimals(sigma, 2);
  return number(value, decimals) + " ± " + number(sigma, decimals) + after;
}

std::string shownNumber(double value, double sigma, std::string_view si) {
  return shownNumber(value, sigma, shownUnit(si));
}

int significantDecimals(double value, int digits) {
  return value == 0.0 ? 0 : digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
}

std::string withMinus(std::string number) {
  if (number.starts_with('-')) number.replace(0, 1, "−");
  return number;
}

}  // namespace capstan::base
