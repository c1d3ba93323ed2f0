#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/base/names.h"

namespace capstan::estimation {

/// What a mean NIS, divided by its degrees of freedom, says of a filter whose expectation is 1.
enum class NisVerdict {
  kPass,      ///< inside the band that chance leaves
  kCautious,  ///< below it: the filter expects larger differences than the camera shows
  kTooHigh,   ///< above it: the filter errs by more than it assumes
};

/// `consistent`: whether `mean` lies in its chi-square band (chiSquareBand), which always holds 1.
constexpr NisVerdict judgeNis(double mean, bool consistent) {
  return consistent ? NisVerdict::kPass : mean > 1.0 ? NisVerdict::kTooHigh : NisVerdict::kCautious;
}

/// What the verdict means and what to do, without a full stop; empty for kPass.
std::string_view adviceOf(NisVerdict verdict);

}  // namespace capstan::estimation

template <>
struct capstan::base::NamesOf<capstan::estimation::NisVerdict> {
  using V = capstan::estimation::NisVerdict;
  static constexpr std::array value = {std::pair{V::kPass, "pass"}, std::pair{V::kCautious, "cautious"},
                                       std::pair{V::kTooHigh, "FAIL, too high"}};
};
