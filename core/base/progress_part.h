#pragma once

#include <string>

#include "core/base/progress.h"

namespace capstan::base {

/// The part of a whole that some work is: its own 0…1 within `begin`…`end`, its words behind `of`, the
/// whole's.
struct ProgressPart {
  double begin = 0.0, end = 1.0;
  std::string of = {};

  /// A part of this part.
  ProgressPart within(double from, double to) const {
    return {begin + from * (end - begin), begin + to * (end - begin), of};
  }
  void report(Progress* whole, double fraction, const std::string& doing) const {
    if (whole) whole->report(begin + fraction * (end - begin), of.empty() ? doing : of + ", " + doing);
  }
};

}  // namespace capstan::base
