#include "core/diagnosis/report/tolerance.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "core/base/error.h"

namespace capstan::diagnosis {
namespace {

struct Unit {
  std::string_view name;
  double factor;
  double Tolerance::*size;
};
constexpr std::array kUnits = {Unit{"deg", base::kRadiansPerDegree, &Tolerance::angle},
                               Unit{"rad", 1.0, &Tolerance::angle}, Unit{"mm", 1e-3, &Tolerance::length},
                               Unit{"um", 1e-6, &Tolerance::length}, Unit{"m", 1.0, &Tolerance::length}};

[[noreturn]] void refuse(std::string_view part, const std::string& option) {
  throw base::InputError({"", 0, option, std::string(part),
                          "is no angle or length greater than zero with its unit",
                          "Write for example 0.02deg,0.01mm; units: deg, rad, mm, um, m"});
}

void parsePart(std::string_view part, const std::string& option, Tolerance& tolerance) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  const std::string_view unit = part.substr(static_cast<std::size_t>(end - part.data()));
  if (error != std::errc() || !std::isfinite(value) || !(value > 0.0)) refuse(part, option);
  for (const Unit& known : kUnits)
    if (known.name == unit) {
      tolerance.*known.size = known.factor * value;
      return;
    }
  refuse(part, option);
}

}  // namespace

Tolerance parseTolerance(std::string_view text, const std::string& option) {
  Tolerance tolerance;
  while (true) {
    const std::size_t comma = text.find(',');
    parsePart(text.substr(0, comma), option, tolerance);
    if (comma == std::string_view::npos) return tolerance;
    text.remove_prefix(comma + 1);
  }
}

std::string formatTolerance(const Tolerance& tolerance) {
  return fmt::format("{:.6g}deg,{:.6g}mm", base::toDegrees(tolerance.angle),
                     base::toMillimetres(tolerance.length));
}

}  // namespace capstan::diagnosis
