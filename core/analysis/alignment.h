#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/tracking/snapshot.h"

namespace capstan::analysis {

/// Joint positions of transmission kinematics at equal steps of kStep [s]: what two sessions are aligned by.
class MotionSeries {
 public:
  static constexpr double kStep = 0.02;  // [s]

  /// Takes every snapshot in order; positions between the steps are interpolated, and a gap of more than
  /// kGap is filled with the position before it.
  void add(const tracking::Snapshot& snapshot) { add(snapshot.t, snapshot.q_link_kin); }
  void add(double t, const Eigen::Vector3d& q);

  double begin() const { return begin_; }
  double end() const { return begin_ + kStep * static_cast<double>(positions_.size()); }
  const std::vector<Eigen::Vector3d>& positions() const { return positions_; }

 private:
  static constexpr double kGap = 0.5;  // [s]
  double begin_ = 0.0, last_t_ = 0.0;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> positions_;
};

/// Offset between the times of two sessions with one motion.
struct Alignment {
  double offset = 0.0;       ///< time in b minus time in a at the same place of the motion [s]
  double correlation = 0.0;  ///< of the joint speeds there, −1 to 1
  double second_best = 0.0;  ///< highest correlation at an offset that differs by more than kApart
  double overlap = 0.0;      ///< time that both sessions have then [s]

  static constexpr double kSame = 0.7, kClear = 0.1, kApart = 1.0;
  /// The sessions have the same motion.
  bool same() const { return correlation >= kSame; }
  /// No other offset fits nearly as well, as it would for a motion that repeats.
  bool clear() const { return same() && correlation - second_best >= kClear; }
};

/// The offset with the highest correlation of the joint speeds, each joint weighted by its own RMS speed. At
/// least a third of the shorter session overlaps. None: a session shorter than 2 s or at rest.
std::optional<Alignment> alignmentOf(const MotionSeries& a, const MotionSeries& b);

}  // namespace capstan::analysis
