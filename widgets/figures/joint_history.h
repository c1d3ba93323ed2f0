#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>

#include "core/tracking/snapshot.h"
#include "widgets/figures/ring.h"

namespace capstan::widgets {

/// What the plots of one joint show at one instant, in the joint's screen unit (deg, deg, mm). NaN: not
/// known.
struct JointValues {
  float truth, kinematic, ukf, ukf_sigma;
};

/// The curves of the newest ten minutes and more, for zooming from one sample to the whole session, in fixed
/// memory (about 16 MB). Rows are kept as they came; above them lies a pyramid of buckets of 4, 16, 64 … rows
/// with the lowest and highest value of each, so that a drawing takes few points at any zoom and no spike is
/// lost.
class JointHistory {
 public:
  static constexpr std::size_t kRows = 163'840;  ///< 10.5 min at 200 rows and 60 camera updates a second
  static constexpr std::size_t kCameraPoints = 65'536;  ///< 18 min at 60 Hz
  static constexpr std::size_t kSpans = 8'192;          ///< occlusions
  static constexpr double kSetBack = 1.0;               ///< back in time by more: another clock [s]
  static constexpr int kJoints = 3;

  struct Row {
    double t = 0.0;
    std::array<JointValues, kJoints> joint;
  };
  struct Bucket {
    double t = 0.0;  ///< of its first row
    std::array<JointValues, kJoints> low, high;
  };
  struct CameraPoint {
    double t = 0.0;  ///< exposure
    std::array<float, kJoints> value;
  };
  struct Span {
    double begin = 0.0, end = 0.0;
  };

  explicit JointHistory(std::size_t rows = kRows);

  /// Takes a snapshot; one at the time of the last replaces it, one before the last is ignored, and one more
  /// than kSetBack before it begins the history anew.
  void append(const tracking::Snapshot& snapshot);
  void clear();

  bool empty() const { return rows_.empty(); }
  double begin() const { return rows_.empty() ? 0.0 : rows_[0].t; }
  double end() const { return rows_.empty() ? 0.0 : rows_.back().t; }

  /// Calls `draw(t, step, low, high)`, a bucket of `step` seconds from t on, in order of time over [begin,
  /// end] and one step beyond each end, with the finest level that takes at most `most` calls, else the
  /// coarsest. low == high where single rows are drawn.
  template <class Draw>
  void forEach(double begin, double end, std::size_t most, Draw&& draw) const;

  /// The row nearest in time to t; nothing while empty.
  std::optional<Row> at(double t) const;
  /// The camera observation nearest to t if within `reach` [s].
  std::optional<CameraPoint> cameraAt(double t, double reach) const;

  const Ring<Row>& rows() const { return rows_; }
  const Ring<CameraPoint>& camera() const { return camera_; }
  /// Times when the marker was lost in a picture, or the tip unseen; the last may still be going on.
  const Ring<Span>& occluded() const { return occluded_; }

 private:
  void fold(const Row& row);

  Ring<Row> rows_;
  std::vector<Ring<Bucket>> levels_;  ///< level k holds buckets of 4^(k+1) rows
  Ring<CameraPoint> camera_;
  Ring<Span> occluded_;
  bool occluded_now_ = false;
};

template <class Draw>
void JointHistory::forEach(double begin, double end, std::size_t most, Draw&& draw) const {
  const auto range = [&](const auto& ring) {
    const std::size_t first = ring.partitionPoint([&](const auto& item) { return item.t < begin; });
    const std::size_t last = ring.partitionPoint([&](const auto& item) { return item.t <= end; });
    return std::pair{first > 0 ? first - 1 : 0, last < ring.size() ? last + 1 : last};
  };
  if (const auto [first, last] = range(rows_); last - first <= most) {
    for (std::size_t i = first; i < last; ++i) draw(rows_[i].t, 0.0, rows_[i].joint, rows_[i].joint);
    return;
  }
  for (const auto& level : levels_) {
    const auto [first, last] = range(level);
    if (last - first > most && &level != &levels_.back()) continue;
    for (std::size_t i = first; i < last; ++i) {
      const double next = i + 1 < level.size() ? level[i + 1].t : rows_.back().t;
      draw(level[i].t, next - level[i].t, level[i].low, level[i].high);
    }
    return;
  }
}

}  // namespace capstan::widgets
