#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>

#include "core/tracking/snapshot.h"
#include "widgets/figures/min_max_pyramid.h"
#include "widgets/figures/ring.h"

namespace capstan::widgets {

/// What the plots of one joint show at one instant, in the joint's screen unit (deg, deg, mm). NaN: not
/// known.
struct JointValues {
  float truth, kinematic, ukf, ukf_sigma;
};

/// The curves of a session of a day and more, for zooming from one sample to all of it, in fixed memory
/// (kBytes). The newest rows and camera measurements are kept as they came; above them lies a pyramid
/// (min_max_pyramid.h) that keeps the lowest and highest value of each block of older ones, so that a drawing
/// takes few points at any zoom and no spike is lost.
class JointHistory {
 public:
  static constexpr std::size_t kRows = 163'840;  ///< 10.5 min at 200 rows and 60 camera updates a second
  static constexpr std::uint64_t kReach = 86'400'000;       ///< rows in blocks: 24 h at 1 kHz
  static constexpr std::size_t kCameraPoints = 65'536;      ///< 18 min at 60 Hz
  static constexpr std::uint64_t kCameraReach = 5'184'000;  ///< in blocks: 24 h at 60 Hz
  static constexpr std::size_t kSpans = 8'192;              ///< occlusions; older ones to a block
  static constexpr std::size_t kBytes = 46'000'000;         ///< of all of it, at most
  static constexpr double kSetBack = 1.0;                   ///< back in time by more: another clock [s]
  static constexpr int kJoints = 3;

  struct Row {
    double t = 0.0;
    std::array<JointValues, kJoints> joint;
    bool occluded = false;  ///< of the highest of a block: in one of its rows
  };
  struct CameraPoint {
    double t = 0.0;  ///< exposure
    std::array<float, kJoints> value;
  };
  struct Span {
    double begin = 0.0, end = 0.0;
  };

  /// For a day.
  JointHistory() : JointHistory(kRows, kReach, kCameraReach) {}
  /// For `rows` and no more.
  explicit JointHistory(std::size_t rows) : JointHistory(rows, rows, kCameraPoints) {}

  /// Takes a snapshot; one at the time of the last replaces it, one before the last is ignored, and one more
  /// than kSetBack before it begins the history again.
  void append(const tracking::Snapshot& snapshot);
  void clear();

  bool empty() const { return rows_.empty(); }
  double begin() const { return rows_.begin(); }
  double end() const { return rows_.end(); }
  /// From here on every row is there; before, the lowest and highest values of blocks.
  double detailBegin() const { return rows_.detailBegin(); }
  /// The same of the camera's measurements, of which fewer come: earlier.
  double cameraDetailBegin() const { return camera_.detailBegin(); }
  /// Length of the shortest block about time t [s]; 0 where every row is there.
  double blockAt(double t) const { return rows_.blockAt(t); }
  /// Changes with every snapshot that is taken.
  std::uint64_t revision() const { return revision_; }
  /// Memory that it holds.
  std::size_t bytes() const;

  /// Calls `draw(t, step, low, high)` with the values of the three joints as MinMaxPyramid::forEach does.
  template <class Draw>
  void forEach(double begin, double end, std::size_t most, Draw&& draw) const {
    rows_.forEach(begin, end, most, [&](double t, double step, const Row& low, const Row& high) {
      draw(t, step, low.joint, high.joint);
    });
  }
  /// The same of the camera's measurements, with an array of a value for each joint.
  template <class Draw>
  void forEachCamera(double begin, double end, std::size_t most, Draw&& draw) const {
    camera_.forEach(begin, end, most,
                    [&](double t, double step, const CameraPoint& low, const CameraPoint& high) {
                      draw(t, step, low.value, high.value);
                    });
  }
  /// Calls `draw(begin, end)` for the occlusions that touch [begin, end], in the order of time. Of those
  /// older than the newest kSpans the ends are those of blocks, of which about `most` are looked at.
  template <class Draw>
  void forEachOcclusion(double begin, double end, std::size_t most, Draw&& draw) const;

  /// The row nearest in time to t; nothing where no single row is kept.
  std::optional<Row> at(double t) const;
  /// The camera observation nearest to t if within `reach` [s].
  std::optional<CameraPoint> cameraAt(double t, double reach) const;

  const Ring<Row>& rows() const { return rows_.rows(); }
  const Ring<CameraPoint>& camera() const { return camera_.rows(); }
  /// The newest times when the marker was lost in a picture, or the tip unseen; the last may still be going
  /// on.
  const Ring<Span>& occluded() const { return occluded_; }

 private:
  JointHistory(std::size_t rows, std::uint64_t reach, std::uint64_t camera_reach);

  MinMaxPyramid<Row> rows_;
  MinMaxPyramid<CameraPoint> camera_;
  Ring<Span> occluded_;
  bool occluded_now_ = false;
  std::uint64_t revision_ = 0;
};

bool widen(JointHistory::Row& low, JointHistory::Row& high, const JointHistory::Row& by);
bool widen(JointHistory::CameraPoint& low, JointHistory::CameraPoint& high,
           const JointHistory::CameraPoint& by);

template <class Draw>
void JointHistory::forEachOcclusion(double begin, double end, std::size_t most, Draw&& draw) const {
  const bool forgotten = occluded_.pushed() > occluded_.size();
  const double exact = forgotten ? occluded_[0].begin : begin;
  if (begin < exact) {
    std::optional<Span> span;
    rows_.forEach(begin, std::min(end, exact), most, [&](double t, double step, const Row&, const Row& high) {
      if (t >= exact) return;
      if (span && span->end < t) span->end = t;
      if (span && !high.occluded) draw(span->begin, span->end), span.reset();
      if (high.occluded) span = Span{span ? span->begin : t, std::min(t + step, exact)};
    });
    if (span) draw(span->begin, span->end);
  }
  std::size_t i = occluded_.partitionPoint([&](const Span& span) { return span.end < begin; });
  for (; i < occluded_.size() && occluded_[i].begin <= end; ++i) draw(occluded_[i].begin, occluded_[i].end);
}

}  // namespace capstan::widgets
