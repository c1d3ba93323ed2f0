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

/// Value with sigma, both in SI: "0.420 ± 0.031 mm". Sigma has two significant digits, and the value is
/// rounded to the same decimal; to three digits of its own if sigma is 0 or not finite. Both have one power
/// of ten if the larger one is 1e6 or more, or if they need more than six decimals: "(1.05 ± 0.15)·10⁶ N". A
/// value that is not finite is "unknown".
std::string shownNumber(double value, double sigma, const ShownUnit& unit);
/// The same in shownUnit(si).
std::string shownNumber(double value, double sigma, std::string_view si);

/// Number of decimals for `digits` significant digits of `value`: negative for large values, 0 for zero.
int significantDecimals(double value, int digits);

/// Text of a number in which a leading hyphen is replaced by a minus sign (U+2212).
std::string withMinus(std::string number);

}  // namespace capstan::base
