#pragma once

#include <numbers>

namespace capstan::test {

/// A whole turn [rad].
inline constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace capstan::test
