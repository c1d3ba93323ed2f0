#pragma once

#include "widgets/figures/joint_history.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Statistics of one curve of a joint in a time range, in the joint's screen unit.
struct RangeStatistics {
  std::size_t count = 0;  ///< values; without any the others are NaN
  double mean, sigma;     ///< sigma: standard deviation about the mean
  double rms;             ///< about zero
};

/// Statistics over the rows that `history` stores unchanged in [begin, end] (after detailBegin()).
RangeStatistics statisticsOf(const JointHistory& history, int joint, Quantity quantity, double begin,
                             double end);

}  // namespace capstan::widgets
