#pragma once

#include <numbers>

/// SI inside; degrees and millimetres only where a person reads or writes them.
namespace capstan::base {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

constexpr double toDegrees(double radians) { return radians / kRadiansPerDegree; }
constexpr double toRadians(double degrees) { return degrees * kRadiansPerDegree; }
constexpr double toMillimetres(double metres) { return metres * 1e3; }
constexpr double degreesOrMillimetres(double value, bool angle) {
  return angle ? toDegrees(value) : toMillimetres(value);
}

}  // namespace capstan::base
