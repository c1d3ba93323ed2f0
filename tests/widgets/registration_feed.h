#pragma once

#include <limits>

#include "core/base/random.h"
#include "core/registration/registration_guide.h"
#include "tests/widgets/scene_snapshot.h"

namespace capstan::test {

/// Snapshots of an arm at rest (or drifting) near its hard stop, seen by cameras whose true pose is `truth`:
/// motors at 1 kHz, one camera sample every 66 ms with Gaussian noise on the triangulated point.
class RegistrationFeed {
 public:
  explicit RegistrationFeed(std::uint64_t seed = 1) : random_(seed) {
    truth = cameraBefore(arm.tip(stop));
    truth.translation() += Eigen::Vector3d(0.004, -0.007, 0.003);
  }

  /// The next millisecond's snapshot.
  const tracking::Snapshot& next() {
    const auto step = count_++;
    q += drift * 1e-3;
    snapshot_ = snapshotAt(arm, 1e-3 * static_cast<double>(step), q, Eigen::Vector3d::Constant(1e-3));
    snapshot_.camera_updated = step % 66 == 0;
    snapshot_.tip_in_camera.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (auto& marker : snapshot_.marker) marker.fault = fault;
    if (snapshot_.camera_updated && fault == vision::MarkerFault::kNone) {
      snapshot_.tip_in_camera = truth.inverse() * arm.tip(q);
      for (int i = 0; i < 3; ++i) snapshot_.tip_in_camera(i) += random_.normal(0.0, noise(i));
      if (outlier_every > 0 && ++points_ % outlier_every == 0) snapshot_.tip_in_camera.z() += 0.05;
    }
    return snapshot_;
  }
  /// Feeds `seconds` to a guide.
  void run(registration::RegistrationGuide& guide, double seconds) {
    for (int i = 0; i < 1000 * seconds; ++i) guide.observe(next());
  }

  robot::Description robot = leftArm();
  robot::ArmKinematics arm{robot};
  Eigen::Vector3d stop = robot::homingOf(robot);
  Eigen::Vector3d q = stop;
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();  ///< [rad/s, rad/s, m/s]
  Eigen::Vector3d noise{1e-4, 1e-4, 8e-4};          ///< of a triangulated point [m]
  Eigen::Isometry3d truth;
  vision::MarkerFault fault = vision::MarkerFault::kNone;
  int outlier_every = 0;

 private:
  base::Random random_;
  tracking::Snapshot snapshot_;
  std::uint64_t count_ = 0;
  int points_ = 0;
};

}  // namespace capstan::test
