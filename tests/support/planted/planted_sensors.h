#pragma once

#include <numbers>

#include "core/recording/measured_table.h"
#include "tests/support/planted/planted_motion.h"

namespace capstan::test {

/// Sensors of the robot. A sensor that is absent has no columns.
struct SensorOptions {
  bool motor_encoders = true;
  bool motor_velocity = true;
  bool motor_torque = true;
  bool joint_encoders = true;
  bool cameras = true;
  bool load_cells = false;
  double turn_count = 2.0 * std::numbers::pi / 80000.0;  ///< resolution of a revolute joint's encoder [rad]
  double slide_count = 5e-6;                             ///< resolution of a prismatic joint's scale [m]
  double frame_rate = 15.0;                              ///< [Hz]
  double frame_delay = 0.040;                            ///< time from exposure until the tip is known [s]
  double pixel_sigma = 0.04;                             ///< noise of the marker's centre in each image [px]
  double focal_length = 650.0;                           ///< [px]
  double baseline = 0.048;                               ///< [m]
  double distance = 0.55;     ///< distance of the cameras from the middle of the workspace [m]
  double load_sigma = 0.005;  ///< noise of the load cells [N·m or N]
  int row_period = 1;         ///< [ms]
};

/// Parallel stereo cameras beside the robot, directed at the middle of the workspace, with noise in their
/// images.
class StereoPair {
 public:
  StereoPair(const Eigen::Vector3d& looks_at, const SensorOptions& options);
  /// Point triangulated from both noisy images, z = f b / (u_left − u_right), in frame 0 [m].
  Eigen::Vector3d see(const Eigen::Vector3d& point, base::Random& random) const;
  /// Standard deviation of see() in the middle of the workspace: root of the sum of the three variances [m].
  double sigma() const;

 private:
  SensorOptions options_;
  Eigen::Matrix3d base_from_camera_;
  Eigen::Vector3d position_;
};

/// Row indices of the exposures of a motion, multiples of row_period. The first is 0–1 frame period after the
/// start. The last is at least frame_delay before the end, since later images are not processed in time.
std::vector<std::size_t> exposures(const PlantedMotion& motion, const SensorOptions& options,
                                   base::Random& random);

/// Tip that the cameras of the planted robot would measure without noise in the image exposed at row k: late
/// by camera_latency, and moved by the similarity transform x' = s R x + t (Horn, JOSA A 4, 1987) of a wrong
/// registration.
Eigen::Vector3d cameraTip(const PlantedMotion& motion, std::size_t k, RigidChain& chain,
                          const Eigen::Vector3d& marker, const std::vector<Planted>& effects);

/// Position at joint encoder i before quantisation: joint position plus encoder drift.
double jointReading(const PlantedMotion& motion, std::size_t k, int i, const std::vector<Planted>& effects);

/// Table of the readings of all sensors. `random` is used for cameras and load cells.
recording::MeasuredTable sense(const PlantedMotion& motion, const robot::Description& nominal,
                               const std::vector<Planted>& effects, const SensorOptions& options,
                               base::Random& random);

}  // namespace capstan::test
