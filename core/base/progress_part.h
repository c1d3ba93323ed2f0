#pragma once

#include <string>

#include "core/base/progress.h"

namespace capstan::base {

/// Part of a larger piece of work. Its own progress 0…1 is reported as `begin`…`end` of the whole. Its phrase
/// is appended to the phrase of the whole, which the field `of` holds.
struct ProgressPart {
  double begin = 0.0, end = 1.0;
  std::string of = {};

  /// Returns the part from `from` to `to`, both in [0, 1], of this part.
  ProgressPart within(double from, double to) const {
    return {begin + from * (end - begin), begin + to * (end - begin), of};
  }
  void report(Progress* whole, double fraction, const std::string& doing) const {
    if (whole) whole->report(begin + fraction * (end - begin), of.empty() ? doing : of + ", " + doing);
  }
};

}  // namespace capstan::base
