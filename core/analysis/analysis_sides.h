#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/analysis/analysis.h"

namespace capstan::analysis {

/// Errors at a common spacing in time, in pieces: between two of them lies a gap (time that was not selected,
/// a camera that saw nothing).
struct SpacedErrors {
  std::vector<double> value;        ///< [deg or mm]
  std::vector<std::size_t> pieces;  ///< their lengths, in order; they add up to value.size()
};

/// Both sides of one difference.
struct Sides {
  SpacedErrors first, second;
  bool paired = false;     ///< sample for sample of the same instants; then the pieces are the same
  std::size_t common = 0;  ///< of paired sides: instants that both have, before they are spaced
};

/// The errors behind `row`, both sides about equally spaced: by the wider spacing of the two, and as much
/// wider as kMostResampled asks for. They are paired where the motion is one (`same_motion`, sameMotion())
/// and the most of the shorter side has its partner at the same time; what has none is excluded.
Sides sidesOf(const AnalysisRow& row, const ErrorRun& a, const ErrorRun* b, const AnalysisOptions& options,
              bool same_motion);

/// Median distance of times that follow each other [s]; 0 for fewer than two.
double spacingOf(const std::vector<double>& t);

/// `errors` by steps of about `spacing` [s] within each piece: its first sample, then the first sample within
/// half of the errors' own spacing of each step, or behind it.
SpacedErrors spaced(const SelectedErrors& errors, double spacing);

}  // namespace capstan::analysis
