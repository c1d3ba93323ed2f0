#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/robot/transmission.h"
#include "core/tracking/sample.h"

namespace capstan::tracking {

/// Takes out motor readings that no arm can have, such as a damaged number between good ones: the motor would
/// have crossed the range that the joint limits need in less than kCrossing. Readings that stay there,
/// kToBelieve in succession or several for kCrossing, are believed: an encoder has slipped or was set to
/// another zero, or the reading before was the damaged one.
class StrayReadings {
 public:
  static constexpr double kCrossing = 0.05;  ///< [s]
  static constexpr int kToBelieve = 5;
  /// Shortest time between two samples that counts [s]: a program that catches up sends them closer.
  static constexpr double kShortest = 2e-3;

  explicit StrayReadings(const robot::Description& robot) {
    const robot::Transmission transmission(robot);
    for (int joint = 0; joint < 3; ++joint) {
      const robot::Joint& range = robot.joints[static_cast<std::size_t>(joint)];
      const Eigen::Vector3d moved = Eigen::Vector3d::Unit(joint) * (range.limit_high - range.limit_low);
      const Eigen::Vector3d travel =
          transmission.motorFromJoint(moved) - transmission.motorFromJoint(Eigen::Vector3d::Zero());
      for (int motor = 0; motor < 3; ++motor)
        watches_[static_cast<std::size_t>(motor)].fastest += std::abs(travel[motor]) / kCrossing;
    }
  }

  void clear() {
    for (Watch& watch : watches_) watch.last.reset(), watch.run = 0;
  }

  /// Replaces stray positions of `sample` by NaN. Returns whether there were any.
  bool takeOut(MotorSample& sample) {
    if (!std::isfinite(sample.t)) return false;
    bool any = false;
    for (int motor = 0; motor < 3; ++motor) {
      double& position = sample.position[motor];
      if (!std::isfinite(position) ||
          !watches_[static_cast<std::size_t>(motor)].isStray({sample.t, position}))
        continue;
      position = std::numeric_limits<double>::quiet_NaN();
      any = true;
    }
    return any;
  }

 private:
  struct Reading {
    double t = 0.0, position = 0.0;  ///< [s], q_m [rad]
  };
  struct Watch {
    double fastest = 0.0;         ///< speed of the motor [rad/s]
    std::optional<Reading> last;  ///< that was believed
    Reading suspect;              ///< newest of a run
    double begin = 0.0;           ///< of the run [s]
    int run = 0;                  ///< stray readings in succession that agree

    /// Also where the clock was set back: then nothing is known of the time between.
    bool isReachable(const Reading& from, const Reading& to) const {
      return to.t < from.t ||
             std::abs(to.position - from.position) <= std::max(to.t - from.t, kShortest) * fastest;
    }
    bool isStray(const Reading& reading) {
      if (last && !isReachable(*last, reading)) {
        run = run > 0 && isReachable(suspect, reading) ? run + 1 : 1;
        if (run == 1) begin = reading.t;
        suspect = reading;
        if (run < kToBelieve && (run == 1 || reading.t - begin < kCrossing)) return true;
      }
      last = reading, run = 0;
      return false;
    }
  };

  std::array<Watch, 3> watches_;
};

}  // namespace capstan::tracking
