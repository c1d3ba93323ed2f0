#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/registration/pair_registration.h"
#include "core/registration/tip_speed.h"
#include "core/robot/description.h"
#include "core/tracking/snapshot.h"

/// Registration in several poses: collects pairs of points while the arm moves through its workspace.
namespace capstan::registration {

/// A pose of the arm that both cameras saw.
struct CollectedPose {
  double t = 0.0;                               ///< exposure [s]
  PointPair pair{};                             ///< marker in the left camera's frame, tip in frame 0 [m]
  Eigen::Vector3d q = Eigen::Vector3d::Zero();  ///< joints by transmission kinematics [rad, rad, m]
  double camera_sigma = 0.0;  ///< RMS error of the point in the camera's frame, predicted [m]
  bool excluded = false;      ///< by the user
};

/// Error or displacement of the registered tip over the whole workspace [m].
struct WorkspaceError {
  double median = 0.0, largest = 0.0;
};

class PoseCollector {
 public:
  static constexpr double kApart = 0.01;     ///< smallest distance of a pose from every other [m]
  static constexpr double kSlow = 0.01;      ///< highest speed of the tip at a pose [m/s]
  static constexpr std::size_t kMost = 100;  ///< number of poses that ends the collection
  static constexpr std::size_t kChecks = 3;  ///< number of poses of a check

  explicit PoseCollector(const robot::Description& robot) : robot_(robot) {}

  /// Collects poses, or stops.
  void setCollecting(bool on) { collecting_ = on; }
  bool collecting() const { return collecting_; }
  /// Ends the collection and a check. The poses stay.
  void stop() { collecting_ = checking_ = false; }
  /// Takes the next snapshot, in order. Returns true when a pose was added.
  bool observe(const tracking::Snapshot& snapshot);
  /// Excludes a pose from the fit, or includes it again.
  void exclude(std::size_t pose, bool excluded);
  void clear();
  /// Computes the tips of all poses again for other constants of the same arm, from their motor positions,
  /// and fits again.
  void setRobot(const robot::Description& robot);
  /// RMS distance of the used poses by another registration than the fit [m]. The fit must exist.
  double rmsBy(const Eigen::Isometry3d& base_from_camera) const;
  /// Collects kChecks further poses that are not in the fit: closuresOf() compares a registration with them.
  void check();

  const robot::Description& robot() const { return robot_; }
  const std::vector<CollectedPose>& poses() const { return poses_; }
  const std::vector<CollectedPose>& checks() const { return checks_; }
  bool checking() const { return checking_; }
  /// Fit of the poses that are not excluded, or why there is none.
  const base::Result<PairRegistration, PairRefusal>& fit() const { return fit_; }
  /// Index of each of the fit's pairs in poses().
  const std::vector<std::size_t>& fitted() const { return fitted_; }
  /// 95 % error by the fit over workspaceTips(). The fit must exist.
  WorkspaceError workspaceError() const;

  /// Writes the poses as a CSV table for `capstan-cli register`: t, x, y, z, cam_x, cam_y, cam_z, excluded.
  /// Throws base::InputError where it cannot be written.
  void save(const std::filesystem::path& path) const;

 private:
  bool isNew(const Eigen::Vector3d& tip, const std::vector<CollectedPose>& poses) const;
  void refit();

  robot::Description robot_;
  bool collecting_ = false, checking_ = false;
  TipSpeed speed_;
  std::vector<CollectedPose> poses_, checks_;
  std::vector<std::size_t> fitted_;
  base::Result<PairRegistration, PairRefusal> fit_ = base::failure(PairRefusal{});
};

}  // namespace capstan::registration
