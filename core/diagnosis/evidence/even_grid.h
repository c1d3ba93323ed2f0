#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"

namespace capstan::diagnosis {

/// The finite samples of one channel, in order of time.
struct Track {
  std::vector<double> t, x;
  std::size_t size() const { return t.size(); }
};
/// Samples x at the times t, without those that are not finite.
Track trackOf(std::span<const double> t, std::span<const double> x);

/// Times of rows with a constant step within each continuous piece of a recording.
struct EvenGrid {
  double step = 0.0;  ///< time between rows [s]
  std::vector<double> t;
  std::vector<Segment> segments;
};

/// Grid over rows at the rising times `t`. A piece ends where no row follows within `longest_gap` or within
/// 3.5 times the median period, whichever is longer; pieces shorter than kShortestPiece are excluded. The
/// step is the duration of the longest piece divided by its number of sampling periods, where a missing row
/// counts as a period. So the grid stays in phase with a clock of constant rate. The grid is empty with fewer
/// than three rows, and if no piece is long enough.
EvenGrid evenGrid(std::span<const double> t, double longest_gap);
inline constexpr double kShortestPiece = 0.2;  ///< shortest piece that is simulated [s]

/// Values of an input channel on the rows of the grid. Each row takes the sample at its time (within a
/// thousandth of a step), or else the linear interpolation between the samples before and after it. A row
/// is NaN outside of the track, and where these two samples are more than `reach` [s] apart. `interpolated`,
/// if given, gets 1 in rows where they are more than 1.75 steps apart.
std::vector<double> interpolateTo(const EvenGrid& grid, const Track& track, double reach,
                                  std::vector<std::uint8_t>* interpolated = nullptr);

/// Values of a reference channel on the rows of the grid. Each sample goes to the row nearest to it; a sample
/// that is off by more than a thousandth of a step is moved to the row's time along the slope between its
/// neighbours. Of several samples at one row the nearest counts. Rows without a sample are NaN.
std::vector<double> placeOn(const EvenGrid& grid, const Track& track);

/// Position of time `t` among the rows of the grid, as TipObservation::row; −1 outside of all segments.
double rowOf(const EvenGrid& grid, double t);

}  // namespace capstan::diagnosis
