#pragma once

#include <Eigen/Core>
#include <QString>
#include <algorithm>
#include <array>
#include <optional>

#include "core/tracking/snapshot.h"
#include "widgets/figures/min_max_pyramid.h"
#include "widgets/figures/ring.h"

namespace capstan::widgets {

/// Values of one joint at one instant, in the joint's screen unit (deg, deg, mm). NaN: unknown.
struct JointValues {
  float truth, kinematic, ukf, ukf_sigma;
};

/// The curves of a session of a day or more, in fixed memory (kBytes), for zooming from one sample to the
/// whole session. The newest rows and camera measurements are stored unchanged. For older ones a pyramid
/// (min_max_pyramid.h) stores the lowest and highest value of each block, so that a drawing needs few points
/// at any zoom and no spike is lost.
class JointHistory {
 public:
  static constexpr std::size_t kRows = 163'840;  ///< 10.5 min at 200 rows and 60 camera updates per second
  static constexpr std::uint64_t kReach = 86'400'000;       ///< rows in blocks: 24 h at 1 kHz
  static constexpr std::size_t kCameraPoints = 65'536;      ///< 18 min at 60 Hz
  static constexpr std::uint64_t kCameraReach = 5'184'000;  ///< points in blocks: 24 h at 60 Hz
  static constexpr std::size_t kSpans = 8'192;  ///< newest occlusions with exact times; older ones: by block
  static constexpr std::size_t kBytes = 46'000'000;  ///< upper limit of the memory
  static constexpr double kSetBack = 1.0;  ///< a larger step back in time is another clock: cleared [s]
  static constexpr int kJoints = 3;

  struct Row {
    double t = 0.0;
    std::array<JointValues, kJoints> joint;
    bool occluded = false;  ///< in the `high` row of a block: true if any of its rows is
  };
  struct CameraPoint {
    double t = 0.0;  ///< time of exposure [s]
    std::array<float, kJoints> value;
  };
  struct Span {
    double begin = 0.0, end = 0.0;
  };

  /// History with room for a day.
  JointHistory() : JointHistory(kRows, kReach, kCameraReach) {}
  /// History of the newest `rows` rows, without blocks of older ones.
  explicit JointHistory(std::size_t rows) : JointHistory(rows, rows, kCameraPoints) {}

  /// Adds a snapshot. A snapshot with the time of the last one replaces it. An earlier snapshot is ignored,
  /// or clears the history first if it is more than kSetBack earlier.
  void append(const tracking::Snapshot& snapshot);
  /// Adds the row of a snapshot alone, or its camera measurement alone.
  void appendRow(const tracking::Snapshot& snapshot);
  void appendCamera(const tracking::Snapshot& snapshot);
  void clear();

  /// Whether JointValues::truth is the robot's own kinematics, which is no truth.
  bool ownKinematics() const { return own_kinematics_; }
  /// What legends and tables call JointValues::truth.
  QString referenceName() const;

  bool empty() const { return rows_.empty(); }
  double begin() const { return rows_.begin(); }
  double end() const { return rows_.end(); }
  /// Time from which on every row is stored; before it, the lowest and highest values of blocks.
  double detailBegin() const { return rows_.detailBegin(); }
  /// The same for camera measurements. As fewer of them arrive, it is earlier than detailBegin().
  double cameraDetailBegin() const { return camera_.detailBegin(); }
  /// Length of the shortest block about time t [s]; 0 where every row is stored.
  double blockAt(double t) const { return rows_.blockAt(t); }
  /// Counter that changes with every snapshot added.
  std::uint64_t revision() const { return revision_; }
  /// Allocated memory [bytes].
  std::size_t bytes() const;

  /// Calls `draw(t, step, low, high)` with the values of the three joints as MinMaxPyramid::forEach does.
  template <class Draw>
  void forEach(double begin, double end, std::size_t most, Draw&& draw) const {
    rows_.forEach(begin, end, most, [&](double t, double step, const Row& low, const Row& high) {
      draw(t, step, low.joint, high.joint);
    });
  }
  /// The same for camera measurements, with an array of one value per joint.
  template <class Draw>
  void forEachCamera(double begin, double end, std::size_t most, Draw&& draw) const {
    camera_.forEach(begin, end, most,
                    [&](double t, double step, const CameraPoint& low, const CameraPoint& high) {
                      draw(t, step, low.value, high.value);
                    });
  }
  /// Calls `draw(begin, end)` for the occlusions that overlap [begin, end], in order of time. Occlusions
  /// before the newest kSpans begin and end at block boundaries; about `most` blocks are examined to find
  /// them.
  template <class Draw>
  void forEachOcclusion(double begin, double end, std::size_t most, Draw&& draw) const;

  /// The row nearest in time to t; none where rows are stored only in blocks.
  std::optional<Row> at(double t) const;
  /// The camera observation nearest to t, if within `reach` [s].
  std::optional<CameraPoint> cameraAt(double t, double reach) const;

  const Ring<Row>& rows() const { return rows_.rows(); }
  const Ring<CameraPoint>& camera() const { return camera_.rows(); }
  /// The newest intervals in which the marker was lost in an image, or the tip was not observed. The last one
  /// may still continue.
  const Ring<Span>& occluded() const { return occluded_; }

 private:
  JointHistory(std::size_t rows, std::uint64_t reach, std::uint64_t camera_reach);

  MinMaxPyramid<Row> rows_;
  MinMaxPyramid<CameraPoint> camera_;
  Ring<Span> occluded_;
  bool occluded_now_ = false, own_kinematics_ = false;
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
