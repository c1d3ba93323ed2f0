#pragma once

#include <string>
#include <string_view>

namespace capstan::base {

/// Unit for people, in place of an SI unit.
struct ShownUnit {
  double scale = 1.0;  ///< factor from SI
  std::string unit;    ///< "deg", "mm", "deg/s", "N·m/rad" …
};

/// Unit for people: degrees for rad and millimetres for m, also per second and per second²; other units with
/// typographic signs (N·m, s², µm/N).
ShownUnit shownUnit(std::string_view si);

/// Value with sigma, both in SI: "0.420 ± 0.031 mm", rounded to two significant digits of sigma; to three
/// digits of the value if sigma is 0 or not finite. A value that is not finite is "unknown".
std::string shownNumber(double value, double sigma, const ShownUnit& unit);
/// The same in shownUnit(si).
std::string shownNumber(double value, double sigma, std::string_view si);

/// Number of decimals for `digits` significant digits of `value`: negative for large values, 0 for zero.
int significantDecimals(double value, int digits);

/// Text of a number in which a leading hyphen is replaced by a minus sign (U+2212).
std::string withMinus(std::string number);

}  // namespace capstan::base
