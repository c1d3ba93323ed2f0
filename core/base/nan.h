#pragma once

#include <limits>

namespace capstan::base {

/// A number that is missing.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace capstan::base
