#pragma once

#include <string>
#include <string_view>

#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// Unit for people, in place of an SI unit.
struct ShownUnit {
  double scale = 1.0;  ///< factor from SI
  std::string unit;    ///< "deg", "mm", "deg/s", "N·m/rad" …
};

/// Unit for people: degrees for rad and millimetres for m, also per second and per second²; other units with
/// typographic signs (N·m, s², µm/N).
ShownUnit shownUnit(std::string_view si);

/// Value with sigma, "0.420 ± 0.031 mm", rounded to two significant digits of sigma; to three digits of the
/// value if sigma is 0 or not finite. A value that is not finite is "unknown".
std::string shownNumber(double value, double sigma, std::string_view si);

/// Parameter with its name, "half width 0.420 ± 0.031 mm". Shares are in "%"; joint numbers and yes/no values
/// (1 or 0) have no unit.
std::string shownParameter(const FoundParameter& parameter);
/// The same without the name: "0.420 ± 0.031 mm".
std::string shownValue(const FoundParameter& parameter);
/// Name of a parameter in words: "half width".
std::string shownName(std::string_view parameter);

/// Location of an effect: "joint 2"; for joint 0 "whole arm" or "cameras".
std::string shownJoint(std::string_view effect, int joint);

/// Share of a variance in words: "nearly all of it", "about half of it" … "no significant part of it".
std::string shareWords(double share);

}  // namespace capstan::diagnosis
