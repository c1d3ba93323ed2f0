#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "widgets/figures/ring.h"

namespace capstan::widgets {

/// Widens [low, high] to include `by`; returns whether this changed it. NaN is no value: it does not widen
/// the range, and a number replaces it.
inline bool widen(float& low, float& high, float by) {
  const bool less = by < low || (low != low && by == by), more = by > high || (high != high && by == by);
  if (less) low = by;
  if (more) high = by;
  return less || more;
}

/// Rows over time in bounded memory. The newest `rows` are stored unchanged. Older ones are stored as blocks
/// of 4, 16, 64 … rows with the lowest and the highest value of each, so that no spike is lost. Level k ≥ 1
/// has blocks of 4^k rows and covers the last rows · 4^(k−1) rows, but not more than about `reach`. A row
/// that is r times as old as the oldest unchanged one is therefore in a block of at most 16 r rows.
///
/// A Row has a time `t` [s] and a function bool widen(Row& low, Row& high, const Row& by), which does not
/// change the times and returns whether it widened anything. Nothing is allocated after construction.
template <class Row>
class MinMaxPyramid {
 public:
  static constexpr std::uint64_t kRatio = 4;          ///< block size ratio of successive levels
  static constexpr std::uint64_t kLeastBlocks = 256;  ///< of the coarsest level, at least

  struct Block {
    Row low, high;  ///< low.t: time of the first row; high.t: time of the last
  };

  MinMaxPyramid(std::size_t rows, std::uint64_t reach) : rows_(rows), remembers_(reach > rows) {
    constexpr std::uint64_t kAtEnds = 2;  // blocks that are cut, so that each level covers the finer one
    const std::uint64_t most = rows / kRatio + kAtEnds;
    const std::uint64_t whole = std::max<std::uint64_t>(reach, rows);
    std::uint64_t reached = 0;
    for (std::uint64_t size = kRatio; reached < whole || whole / size >= kLeastBlocks; size *= kRatio) {
      levels_.emplace_back(static_cast<std::size_t>(std::min(whole / size + kAtEnds, most)));
      reached = levels_.back().capacity() * size;
    }
  }

  void clear() {
    rows_.clear();
    for (auto& level : levels_) level.clear();
  }

  /// Adds a row that is later than the newest.
  void push(const Row& row) {
    const std::uint64_t index = rows_.pushed();
    rows_.push(row);
    std::uint64_t size = kRatio;
    bool wider = true;  // what does not widen a block widens no coarser one
    for (auto& level : levels_) {
      if (index % size == 0) {
        level.push({row, row});
      } else {
        wider = wider && widen(level.back().low, level.back().high, row);
        level.back().high.t = row.t;
      }
      size *= kRatio;
    }
  }

  /// Replaces the newest row by `row`, of the same time. Blocks include both.
  void replaceNewest(const Row& row) {
    rows_.back() = row;
    for (auto& level : levels_) widen(level.back().low, level.back().high, row);
  }

  bool empty() const { return rows_.empty(); }
  /// Time of the oldest row, stored unchanged or in a block.
  double begin() const {
    double begin = detailBegin();
    for (const auto& level : levels_)
      if (remembers_ && !level.empty()) begin = std::min(begin, level[0].low.t);
    return begin;
  }
  /// Time from which on every row is stored unchanged.
  double detailBegin() const { return rows_.empty() ? 0.0 : rows_[0].t; }
  double end() const { return rows_.empty() ? 0.0 : rows_.back().t; }
  const Ring<Row>& rows() const { return rows_; }

  /// Allocated memory [bytes].
  std::size_t bytes() const {
    std::size_t sum = rows_.capacity() * sizeof(Row);
    for (const auto& level : levels_) sum += level.capacity() * sizeof(Block);
    return sum;
  }

  /// Length of the shortest block about time t [s]; 0 where every row is stored, and before begin().
  double blockAt(double t) const {
    if (t >= detailBegin()) return 0.0;
    for (std::size_t k = 1; k <= levels_.size(); ++k) {
      const auto& level = levels_[k - 1];
      if (level.empty() || t < level[0].low.t) continue;
      const std::size_t next = level.partitionPoint([&](const Block& block) { return block.low.t <= t; });
      return (next < level.size() ? level[next].low.t : end()) - level[next - 1].low.t;
    }
    return 0.0;
  }

  /// Calls draw(t, step, low, high) in order of time over [begin, end] and one step beyond each end. low and
  /// high are Rows: the lowest and highest values from t to t + step, or twice the same row with step 0. It
  /// draws the finest level that needs at most `most` calls, else the coarsest; before the beginning of that
  /// level it draws coarser ones.
  template <class Draw>
  void forEach(double begin, double end, std::size_t most, Draw&& draw) const {
    if (empty()) return;
    std::size_t finest = 0;
    while (finest < levels_.size() && calls(finest, begin, end) > most) ++finest;
    for (std::size_t k = levels_.size(); k > finest; --k) drawBlocks(k, finest, begin, end, draw);
    if (finest > 0) return drawBlocks(finest, finest, begin, end, draw);
    const auto [first, last] = rangeOf(rows_, begin, end, kNever);
    for (std::size_t i = first; i < last; ++i) draw(rows_[i].t, 0.0, rows_[i], rows_[i]);
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  static double timeOf(const Row& row) { return row.t; }
  static double timeOf(const Block& block) { return block.low.t; }

  /// Index range of the items that overlap [begin, end] and of one beyond each end, limited to those before
  /// `until`.
  template <class Items>
  static std::pair<std::size_t, std::size_t> rangeOf(const Items& items, double begin, double end,
                                                     double until) {
    const auto before = [&](double t) {
      return items.partitionPoint([&](const auto& item) { return timeOf(item) < t; });
    };
    const std::size_t first = before(begin), last = before(std::nextafter(end, kNever)) + 1;
    const std::size_t limit = before(until);
    return {std::min(first > 0 ? first - 1 : 0, limit), std::min(last, limit)};
  }

  /// Time up to which level k is drawn if `finest` is the finest level: the beginning of the next finer one.
  double until(std::size_t k, std::size_t finest) const {
    if (k == finest) return kNever;
    return k == 1 ? detailBegin() : levels_[k - 2][0].low.t;
  }

  std::size_t calls(std::size_t finest, double begin, double end) const {
    std::size_t sum = 0;
    const auto add = [&](const auto& items, std::size_t k) {
      const auto [first, last] = rangeOf(items, begin, end, until(k, finest));
      sum += last - first;
    };
    if (finest == 0) add(rows_, 0);
    for (std::size_t k = std::max<std::size_t>(finest, 1); k <= levels_.size(); ++k) add(levels_[k - 1], k);
    return sum;
  }

  template <class Draw>
  void drawBlocks(std::size_t k, std::size_t finest, double begin, double end, Draw&& draw) const {
    const auto& level = levels_[k - 1];
    const double stop = until(k, finest);
    const auto [first, last] = rangeOf(level, begin, end, stop);
    for (std::size_t i = first; i < last; ++i) {
      const double t = level[i].low.t;
      draw(t, std::min(level[i].high.t, stop) - t, level[i].low, level[i].high);
    }
  }

  Ring<Row> rows_;
  bool remembers_;                   ///< whether blocks of rows older than rows_ are used
  std::vector<Ring<Block>> levels_;  ///< levels_[k − 1] is level k
};

}  // namespace capstan::widgets
