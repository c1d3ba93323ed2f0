#include "core/diagnosis/evidence/even_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/nan.h"
#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

constexpr double kSameTime = 1e-3;    // of a step: largest difference of times that count as equal
constexpr double kRowMissing = 1.75;  // periods between two rows from which on a row is missing between them

/// Pieces [begin, end) of the times without a pause longer than the longest gap or 3.5 median periods.
std::vector<Segment> piecesOf(std::span<const double> t, double longest_gap) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < t.size(); ++i) periods.push_back(t[i] - t[i - 1]);
  const double pause = std::max(longest_gap, 3.5 * stats::median(periods));
  std::vector<Segment> pieces;
  std::size_t begin = 0;
  for (std::size_t i = 1; i <= t.size(); ++i)
    if (i == t.size() || t[i] - t[i - 1] > pause) pieces.push_back({begin, i}), begin = i;
  return pieces;
}

double spanOf(std::span<const double> t, const Segment& piece) { return t[piece.end - 1] - t[piece.begin]; }

/// Number of periods in the piece, missing rows counted.
double periodsIn(std::span<const double> t, const Segment& piece) {
  std::vector<double> periods;
  for (std::size_t i = piece.begin + 1; i < piece.end; ++i) periods.push_back(t[i] - t[i - 1]);
  const double typical = stats::median(periods);
  double count = 0.0;
  for (const double period : periods)
    count += period > kRowMissing * typical ? std::round(period / typical) : 1.0;
  return count;
}

/// Index of the sample at `time`; −1: none.
std::ptrdiff_t sampleAt(const Track& track, std::size_t after, double time, double tolerance) {
  const auto i = static_cast<std::ptrdiff_t>(after);
  if (after < track.size() && track.t[after] - time <= tolerance) return i;
  if (after > 0 && time - track.t[after - 1] <= tolerance) return i - 1;
  return -1;
}

/// Slope of the track at sample i, between its neighbours.
double slopeAbout(const Track& track, std::size_t i) {
  const std::size_t a = i > 0 ? i - 1 : i, b = i + 1 < track.size() ? i + 1 : i;
  return b > a ? (track.x[b] - track.x[a]) / (track.t[b] - track.t[a]) : 0.0;
}

}  // namespace

Track trackOf(std::span<const double> t, std::span<const double> x) {
  Track track;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (std::isfinite(x[i])) track.t.push_back(t[i]), track.x.push_back(x[i]);
  return track;
}

EvenGrid evenGrid(std::span<const double> t, double longest_gap) {
  EvenGrid grid;
  if (t.size() < 3) return grid;
  const std::vector<Segment> pieces = piecesOf(t, longest_gap);
  const Segment longest = *std::max_element(
      pieces.begin(), pieces.end(), [&](const Segment& a, const Segment& b) { return a.size() < b.size(); });
  if (longest.size() < 2) return grid;
  grid.step = spanOf(t, longest) / periodsIn(t, longest);
  for (const Segment& piece : pieces) {
    const double span = spanOf(t, piece);
    if (span < kShortestPiece) continue;
    const auto rows = static_cast<std::size_t>(std::floor(span / grid.step + kSameTime)) + 1;
    const std::size_t begin = grid.t.size();
    for (std::size_t k = 0; k < rows; ++k)
      grid.t.push_back(t[piece.begin] + static_cast<double>(k) * grid.step);
    grid.segments.push_back({begin, grid.t.size()});
  }
  return grid;
}

std::vector<double> interpolateTo(const EvenGrid& grid, const Track& track, double reach,
                                  std::vector<std::uint8_t>* interpolated) {
  std::vector<double> result(grid.t.size(), base::kNaN);
  if (interpolated) interpolated->resize(grid.t.size(), 0);
  std::size_t after = 0;
  for (std::size_t row = 0; row < grid.t.size(); ++row) {
    const double time = grid.t[row];
    while (after < track.size() && track.t[after] < time) ++after;
    const std::ptrdiff_t same = sampleAt(track, after, time, kSameTime * grid.step);
    if (same >= 0) {
      result[row] = track.x[static_cast<std::size_t>(same)];
      continue;
    }
    if (after == 0 || after == track.size()) continue;
    const double apart = track.t[after] - track.t[after - 1];
    if (interpolated && apart > kRowMissing * grid.step) (*interpolated)[row] = 1;
    if (apart > reach) continue;
    const double share = (time - track.t[after - 1]) / apart;
    result[row] = track.x[after - 1] + share * (track.x[after] - track.x[after - 1]);
  }
  return result;
}

std::vector<double> placeOn(const EvenGrid& grid, const Track& track) {
  std::vector<double> result(grid.t.size(), base::kNaN);
  std::vector<double> nearest(grid.t.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < track.size(); ++i) {
    const double place = rowOf(grid, track.t[i]);
    if (place < 0.0) continue;
    const auto row = std::min(static_cast<std::size_t>(std::lround(place)), grid.t.size() - 1);
    const double late = grid.t[row] - track.t[i];
    if (std::abs(late) >= nearest[row] || std::abs(late) > grid.step) continue;
    nearest[row] = std::abs(late);
    const bool on_it = std::abs(late) <= kSameTime * grid.step;
    result[row] = on_it ? track.x[i] : track.x[i] + late * slopeAbout(track, i);
  }
  return result;
}

double rowOf(const EvenGrid& grid, double t) {
  const double slack = kSameTime * grid.step;
  const auto after = std::upper_bound(
      grid.segments.begin(), grid.segments.end(), t,
      [&](double time, const Segment& segment) { return time < grid.t[segment.begin] - slack; });
  if (after == grid.segments.begin()) return -1.0;
  const Segment& segment = *(after - 1);
  const double place = (t - grid.t[segment.begin]) / grid.step,
               last = static_cast<double>(segment.size() - 1);
  if (place > last + kSameTime) return -1.0;
  const double whole = std::round(place);
  const double row = std::abs(place - whole) <= kSameTime ? whole : place;
  return static_cast<double>(segment.begin) + std::clamp(row, 0.0, last);
}

}  // namespace capstan::diagnosis
