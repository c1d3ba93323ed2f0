#pragma once

#include <string>
#include <string_view>

#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// A unit of SI as people read it.
struct ShownUnit {
  double scale = 1.0;  ///< from SI
  std::string unit;    ///< "deg", "mm", "deg/s", "N·m/rad" …
};

/// Degrees for rad and millimetres for m, also per second or second²; others with their signs in print
/// (N·m, s², µm/N).
ShownUnit shownUnit(std::string_view si);

/// "0.420 ± 0.031 mm": as many decimals as two digits of sigma need; three digits where sigma is not known
/// (0 or not finite). "unknown" for a value that is not finite.
std::string shownNumber(double value, double sigma, std::string_view si);

/// "half width 0.420 ± 0.031 mm"; shares of something as "%", a joint's number and yes or no as they are.
std::string shownParameter(const FoundParameter& parameter);
/// Value and sigma of it alone: "0.420 ± 0.031 mm".
std::string shownValue(const FoundParameter& parameter);
/// Its name in words: "half width".
std::string shownName(std::string_view parameter);

/// "joint 2", or "whole arm" and "cameras" for effects of joint 0.
std::string shownJoint(std::string_view effect, int joint);

/// How much of a variance `share` is, for people: "nearly all of it", "about half of it" … "no significant
/// part of it".
std::string shareWords(double share);

}  // namespace capstan::diagnosis
