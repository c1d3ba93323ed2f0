#pragma once

#include <numbers>

#include "core/recording/measured_table.h"
#include "tests/support/planted/planted_motion.h"

namespace capstan::test {

/// What the robot is fitted with. A sensor that is absent leaves no columns.
struct SensorOptions {
  bool motor_encoders = true;
  bool motor_velocity = true;
  bool motor_torque = true;
  bool joint_encoders = true;
  bool cameras = true;
  bool load_cells = false;
  double turn_count = 2.0 * std::numbers::pi / 80000.0;  ///< of a revolute joint's encoder [rad]
  double slide_count = 5e-6;                             ///< of a prismatic joint's scale [m]
  double frame_rate = 15.0;                              ///< [Hz]
  double frame_delay = 0.040;                            ///< from exposure until the tip is known [s]
  double pixel_sigma = 0.04;                             ///< of the marker's centre in each picture [px]
  double focal_length = 650.0;                           ///< [px]
  double baseline = 0.048;                               ///< [m]
  double distance = 0.55;     ///< of the cameras from the middle of the workspace [m]
  double load_sigma = 0.005;  ///< noise of the load cells [N·m or N]
};

/// Parallel stereo pair that looks at the middle of the workspace from aside; noise in its pictures.
class StereoPair {
 public:
  StereoPair(const Eigen::Vector3d& looks_at, const SensorOptions& options);
  /// The point as both noisy images give it, z = f b / (u_left − u_right), in frame 0 [m].
  Eigen::Vector3d see(const Eigen::Vector3d& point, base::Random& random) const;
  /// Standard deviation of what see() gives at the middle of the workspace: root of the summed variances [m].
  double sigma() const;

 private:
  SensorOptions options_;
  Eigen::Matrix3d base_from_camera_;
  Eigen::Vector3d position_;
};

/// Row indices at which the pictures of a recording are exposed; the first comes 0–1 frame after the start,
/// the last one frame_delay before the end, since later ones are not known in time.
std::vector<std::size_t> exposures(const PlantedMotion& motion, const SensorOptions& options,
                                   base::Random& random);

/// Tip as the cameras of the planted robot would see it without noise, for the picture exposed at row k: late
/// by camera_latency, and moved by the similarity x' = s R x + t (Horn, JOSA A 4, 1987) of a wrong
/// registration.
Eigen::Vector3d cameraTip(const PlantedMotion& motion, std::size_t k, RigidChain& chain,
                          const Eigen::Vector3d& marker, const std::vector<Planted>& effects);

/// What the joint encoder i would tell before it counts: the joint, and its drift.
double jointReading(const PlantedMotion& motion, std::size_t k, int i, const std::vector<Planted>& effects);

/// The recording of all sensors. Seeds: `random` feeds cameras and load cells.
recording::MeasuredTable sense(const PlantedMotion& motion, const robot::Description& nominal,
                               const std::vector<Planted>& effects, const SensorOptions& options,
                               base::Random& random);

}  // namespace capstan::test
