#include "core/diagnosis/report/shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/minus.h"

namespace capstan::diagnosis {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Known {
  std::string_view si;
  double scale;
  std::string_view unit;
};
constexpr std::array kKnown = {Known{"rad", kDegrees, "deg"},
                               Known{"m", 1e3, "mm"},
                               Known{"rad/s", kDegrees, "deg/s"},
                               Known{"m/s", 1e3, "mm/s"},
                               Known{"rad/s^2", kDegrees, "deg/s²"},
                               Known{"m/s^2", 1e3, "mm/s²"},
                               Known{"m/N", 1e6, "µm/N"},
                               Known{"m/rad", 1e3, "mm/rad"}};

/// Names of parameters without a unit that are not shares.
constexpr std::array<std::string_view, 2> kCounts = {"other", "present"};

void replaceAll(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

bool isShare(const FoundParameter& parameter) {
  return parameter.unit.empty() && std::ranges::find(kCounts, parameter.name) == kCounts.end();
}

bool isCount(const FoundParameter& parameter) { return parameter.unit.empty() && !isShare(parameter); }

/// Number with fixed decimals, or with a power of ten if it is large or needs too many decimals.
std::string number(double value, int decimals) {
  constexpr int kMost = 6;
  constexpr double kFar = 1e6;
  const bool far = std::abs(value) >= kFar || decimals > kMost;
  std::string text =
      far ? fmt::format("{:.2e}", value) : fmt::format("{:.{}f}", value, std::max(decimals, 0));
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos) text.erase(0, 1);  // −0
  return base::withMinus(std::move(text));
}

/// Number of decimals for `digits` significant digits of `value`.
int decimalsFor(double value, int digits) {
  return value == 0.0 ? 0 : digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
}

std::string scaled(double value, double sigma, const std::string& unit) {
  const std::string space = unit.empty() || unit == "°" ? "" : " ";
  if (!std::isfinite(value)) return "unknown";
  if (!std::isfinite(sigma) || sigma <= 0.0) return number(value, decimalsFor(value, 3)) + space + unit;
  const int decimals = decimalsFor(sigma, 2);
  return number(value, decimals) + " ± " + number(sigma, decimals) + space + unit;
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

std::string shownNumber(double value, double sigma, std::string_view si) {
  const ShownUnit shown = shownUnit(si);
  return scaled(shown.scale * value, shown.scale * sigma, shown.unit);
}

std::string shownValue(const FoundParameter& parameter) {
  if (isShare(parameter)) return scaled(100.0 * parameter.value, 100.0 * parameter.sigma, "%");
  if (isCount(parameter)) return fmt::format("{:.0f}", parameter.value);
  return shownNumber(parameter.value, parameter.sigma, parameter.unit);
}

std::string shownName(std::string_view parameter) {
  std::string name(parameter);
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string shownParameter(const FoundParameter& parameter) {
  return shownName(parameter.name) + " " + shownValue(parameter);
}

std::string shownJoint(std::string_view effect, int joint) {
  if (joint > 0) return fmt::format("joint {}", joint);
  return effect.starts_with("camera") || effect.starts_with("marker") ? "cameras" : "whole arm";
}

std::string shareWords(double share) {
  struct Words {
    double from;
    std::string_view words;
  };
  constexpr std::array kWords = {Words{0.95, "nearly all of it"},  Words{0.8, "most of it"},
                                 Words{0.6, "two thirds of it"},   Words{0.42, "about half of it"},
                                 Words{0.29, "a third of it"},     Words{0.23, "a quarter of it"},
                                 Words{0.16, "a fifth of it"},     Words{0.08, "a tenth of it"},
                                 Words{0.03, "a twentieth of it"}, Words{0.01, "hardly any of it"}};
  const auto found = std::ranges::find_if(kWords, [share](const Words& w) { return share >= w.from; });
  return std::string(found == kWords.end() ? "no significant part of it" : found->words);
}

}  // namespace capstan::diagnosis
