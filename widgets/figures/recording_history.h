#pragma once

#include "widgets/figures/joint_history.h"

namespace capstan::widgets {

/// History of a recording that is tracked at once: of its snapshots it takes 200 rows per second and every
/// camera sample, as the window does of a session.
class RecordingHistory {
 public:
  void add(const tracking::Snapshot& snapshot) {
    const bool due = snapshot.t >= next_ - 1e-9;
    if (snapshot.motor_samples == 0 || (!due && !snapshot.camera_updated && snapshot.t != last_)) return;
    if (due) next_ = snapshot.t + kStep;
    last_ = snapshot.t;
    history_.append(snapshot);
  }
  const JointHistory& history() const { return history_; }

 private:
  static constexpr double kStep = 0.005;  ///< time between rows without a camera sample [s]

  JointHistory history_;
  double next_ = -1e300;
  double last_ = -1e300;  ///< time of the last row, which is replaced when its reference arrives [s]
};

}  // namespace capstan::widgets
