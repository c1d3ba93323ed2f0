#pragma once

#include "core/base/due_times.h"
#include "core/tracking/snapshot.h"

namespace capstan::live {

/// Chooses the steps that plots show: camera samples, motor samples at a limited rate, and the references
/// that belong to the latter.
class PlottedSteps {
 public:
  /// `rate`: motor samples per second of the session [Hz].
  explicit PlottedSteps(double rate) : due_(rate) {}

  bool take(const tracking::Snapshot& snapshot) {
    if (snapshot.motor_updated) motor_taken_ = due_.due(snapshot.t);
    return snapshot.camera_updated || (motor_taken_ && (snapshot.motor_updated || snapshot.reference_paired));
  }

 private:
  base::DueTimes due_;
  bool motor_taken_ = false;  ///< of the newest motor sample
};

}  // namespace capstan::live
