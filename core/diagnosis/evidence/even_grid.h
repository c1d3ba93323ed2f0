#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"

namespace capstan::diagnosis {

/// The finite samples of one channel, in rising time.
struct Track {
  std::vector<double> t, x;
  std::size_t size() const { return t.size(); }
};
Track trackOf(std::span<const double> t, std::span<const double> x);

/// Rows an even step apart in each of the recording's pieces.
struct EvenGrid {
  double period = 0.0;  ///< between the recording's own rows [s]
  double step = 0.0;    ///< between the grid's [s]
  std::vector<double> t;
  std::vector<Segment> segments;
};

/// The grid over rows at the rising times `t`: pieces end where `longest_gap` (or three periods) pass without
/// a row; pieces of less than kShortestPiece are excluded. The period is the longest piece's span over its
/// number of rows, missing ones counted, so that no row strays from a clock that keeps its rate. `step` 0:
/// the period. Empty without a piece. `step` must not be below the period.
EvenGrid evenGrid(std::span<const double> t, double step, double longest_gap);
inline constexpr double kShortestPiece = 0.2;  ///< [s]

/// The period that evenGrid would find [s]; 0: fewer than three rows.
double ownPeriod(std::span<const double> t, double longest_gap);

/// A channel that drives: on each row the sample at its time (within a thousandth of a period), or else the
/// line between its neighbours. NaN outside of the track and where they are more than `reach` apart.
/// `interpolated`, if given, gets 1 in rows whose neighbours are more than 1.75 periods apart.
std::vector<double> interpolateTo(const EvenGrid& grid, const Track& track, double reach,
                                  std::vector<std::uint8_t>* interpolated = nullptr);

/// A channel that is compared with: each sample at the row nearest to it, moved to the row's time along the
/// line to its neighbours where it is off by more than a thousandth of a period; of several at one row the
/// nearest. NaN in the other rows.
std::vector<double> placeOn(const EvenGrid& grid, const Track& track);

/// Where on the grid time `t` falls: TipObservation::row, or −1 outside of all segments.
double rowOf(const EvenGrid& grid, double t);

}  // namespace capstan::diagnosis
