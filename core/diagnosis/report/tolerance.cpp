#include "core/diagnosis/report/tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

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

[[noreturn]] void refuse(std::string_view part, const std::string& option,
                         const char* reason = "is no angle or length greater than zero with its unit") {
  throw base::InputError({"", 0, option, std::string(part), reason,
                          "Write for example 0.02deg,0.02mm; units: deg, rad, mm, um, m"});
}

/// Parses one part; `given`: the sizes that earlier parts gave.
void parsePart(std::string_view part, const std::string& option, std::vector<double Tolerance::*>& given,
               Tolerance& tolerance) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  const std::string_view unit = part.substr(static_cast<std::size_t>(end - part.data()));
  if (error != std::errc() || !std::isfinite(value) || !(value > 0.0)) refuse(part, option);
  for (const Unit& known : kUnits)
    if (known.name == unit) {
      if (std::ranges::find(given, known.size) != given.end())
        refuse(part, option, "is the second angle or the second length");
      given.push_back(known.size);
      tolerance.*known.size = known.factor * value;
      return;
    }
  refuse(part, option);
}

}  // namespace

Tolerance parseTolerance(std::string_view text, const std::string& option) {
  Tolerance tolerance;
  std::vector<double Tolerance::*> given;
  while (true) {
    const std::size_t comma = text.find(',');
    parsePart(text.substr(0, comma), option, given, tolerance);
    if (comma == std::string_view::npos) return tolerance;
    text.remove_prefix(comma + 1);
  }
}

std::string formatTolerance(const Tolerance& tolerance) {
  return fmt::format("{:.6g}deg,{:.6g}mm", base::toDegrees(tolerance.angle),
                     base::toMillimetres(tolerance.length));
}

}  // namespace capstan::diagnosis
