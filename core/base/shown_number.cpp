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

/// Decimals and common power of ten of a value and its sigma.
struct Format {
  int decimals = 0;  ///< of value / 10^exponent; negative: rounded to tens, hundreds …
  int exponent = 0;
};

double rounded(double value, int decimals) {
  const double power = std::pow(10.0, decimals);
  return std::round(value * power) / power;
}

/// Decimals for `digits` digits of `value` after rounding: two of 0.0996 are 0.10, not 0.100.
int decimalsOf(double value, int digits) {
  const int decimals = significantDecimals(value, digits);
  return std::min(decimals, significantDecimals(rounded(value, decimals), digits));
}

/// A power of ten if the larger number is large or its decimals are many.
Format formatOf(double largest, int decimals) {
  constexpr int kMost = 6;
  constexpr double kFar = 1e6;
  if (largest == 0.0 || (largest < kFar && decimals <= kMost)) return {decimals, 0};
  const int exponent = -significantDecimals(rounded(largest, decimals), 1);
  return {decimals + exponent, exponent};
}

std::string number(double value, const Format& format) {
  value *= std::pow(10.0, -format.exponent);
  if (format.decimals < 0) value = rounded(value, format.decimals);
  std::string text = fmt::format("{:.{}f}", value, std::max(format.decimals, 0));
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);  // −0
  return withMinus(std::move(text));
}

/// "·10⁶"; empty for 10⁰.
std::string powerOfTen(int exponent) {
  constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  if (exponent == 0) return {};
  std::string text = "·10";
  for (const char c : std::to_string(exponent))
    text += c == '-' ? std::string_view("⁻") : kDigits[static_cast<std::size_t>(c - '0')];
  return text;
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
  if (!std::isfinite(sigma) || sigma <= 0.0) {
    const Format format = formatOf(std::abs(value), decimalsOf(value, 3));
    return number(value, format) + powerOfTen(format.exponent) + after;
  }
  const Format format = formatOf(std::max(std::abs(value), sigma), decimalsOf(sigma, 2));
  const std::string both = number(value, format) + " ± " + number(sigma, format);
  return (format.exponent == 0 ? both : "(" + both + ")" + powerOfTen(format.exponent)) + after;
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
