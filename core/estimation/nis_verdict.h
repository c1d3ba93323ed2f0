#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/base/names.h"

namespace capstan::estimation {

/// Verdict on a filter from its mean NIS divided by the degrees of freedom; the expected value is 1.
enum class NisVerdict {
  kPass,      ///< inside the chi-square band
  kCautious,  ///< below the band: the innovations are smaller than the filter expects
  kTooHigh,   ///< above the band: the innovations are larger than the filter expects
};

/// Verdict on `mean`. `consistent` is whether it lies in its band (chiSquareBand()), which always contains 1.
constexpr NisVerdict judgeNis(double mean, bool consistent) {
  return consistent ? NisVerdict::kPass : mean > 1.0 ? NisVerdict::kTooHigh : NisVerdict::kCautious;
}

/// Meaning of the verdict and remedy, without a full stop; empty for kPass.
std::string_view adviceOf(NisVerdict verdict);

}  // namespace capstan::estimation

template <>
struct capstan::base::NamesOf<capstan::estimation::NisVerdict> {
  using V = capstan::estimation::NisVerdict;
  static constexpr std::array value = {std::pair{V::kPass, "pass"}, std::pair{V::kCautious, "cautious"},
                                       std::pair{V::kTooHigh, "FAIL, too high"}};
};
