#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/analysis/analysis.h"

namespace capstan::analysis {

/// Errors at a common spacing in time, in pieces that are separated by gaps (time that was not selected, or a
/// camera without observations).
struct SpacedErrors {
  std::vector<double> value;        ///< errors [deg or mm]
  std::vector<std::size_t> pieces;  ///< lengths of the pieces, in order; their sum is value.size()
};

/// Both sides of one difference.
struct Sides {
  SpacedErrors first, second;
  bool paired = false;     ///< true: samples of both sides are at the same instants, with the same pieces
  std::size_t common = 0;  ///< number of common instants of paired sides, before spacing
};

/// Both sides of the differences in `row`. They have nearly equal spacing: the wider spacing of the two, or
/// wider where kMostResampled requires it. They are paired where the motion is the same (`same_motion`,
/// sameMotion()) and most samples of the shorter side have a partner at the same time; samples without a
/// partner are excluded.
Sides sidesOf(const AnalysisRow& row, const ErrorRun& a, const ErrorRun* b, const AnalysisOptions& options,
              bool same_motion);

/// Median difference of successive times [s]; 0 for fewer than two times.
double spacingOf(const std::vector<double>& t);

/// `errors` thinned to steps of about `spacing` [s] within each piece: its first sample, then for each step
/// the first sample that is at most half of the original spacing before it.
SpacedErrors spaced(const SelectedErrors& errors, double spacing);

}  // namespace capstan::analysis
