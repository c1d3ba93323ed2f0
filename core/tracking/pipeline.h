#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/robot/description.h"
#include "core/tracking/options.h"
#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"
#include "core/vision/camera.h"
#include "core/vision/marker.h"

namespace capstan::tracking {

/// The one data path: samples in, snapshots out; deterministic, single-threaded, allocation-free once warm.
/// - motors → transmission kinematics → q_kin; the filter predicts [q_l, dq_l] (UKF paper (10)) at the motor
/// rate
/// - frames → marker in each region of interest → triangulation → base frame → inverse kinematics → q_cam
/// - q_cam (q_kin while the gate is shut) → square-root UKF update, at the time of exposure → q_ukf
///
/// The gate shuts when a marker is missing, its tip is out of reach, or the innovation lies beyond the χ²
/// gate (a jump). A jump ends when the innovation is back inside, or when `jump_samples` camera samples in a
/// row agree on q_cam − q_kin up to their noise and `jump_drift`: what moves with the motors is the tip, and
/// the filter was wrong. With no camera sample for `missing_after` periods, q_kin is observed at the camera's
/// rate.
///
/// A motor encoder may fail (EncoderWatch). Its joint is then estimated from the camera alone: moved by a
/// random acceleration (UnknownMotion), observed by the camera and, through the coupling, by the other
/// motors' cables. Nothing of q_kin is observed that came from the failed motor; regions of interest, the
/// branch of the inverse kinematics and the jump gate take the estimate in its place, and in occlusion sigma
/// grows as fast as the joint may wander.
///
/// Effects of a robot file are taken into account: those of motor readings and of cameras are undone where
/// samples come in (MotorReading, robot::CameraNumbers), the others act in the filter's model.
class TrackingPipeline {
 public:
  /// For a three-joint remote-centre arm; frames need `rig`, motor and tip samples do not.
  /// Throws base::InputError for a robot of another kind.
  TrackingPipeline(const robot::Description& robot, std::optional<vision::StereoRig> rig,
                   const vision::MarkerOptions& marker, const TrackingOptions& options);
  ~TrackingPipeline();
  TrackingPipeline(TrackingPipeline&&) noexcept;
  TrackingPipeline& operator=(TrackingPipeline&&) noexcept;

  /// From now on frames give q_cam. Until then markers are sought in the whole frame, tip_in_camera is
  /// filled, and the filter runs on q_kin (gate kUnregistered).
  void setRegistration(const Eigen::Isometry3d& base_from_camera);
  const std::optional<Eigen::Isometry3d>& registration() const;

  /// From now on the encoder of motor 0, 1 or 2 is ignored, or used again, whatever was detected.
  void setMotorFailed(int motor, bool failed);

  /// Takes one sample, in order of arrival. The reference stays valid until the next call. Never throws.
  const Snapshot& step(const Sample& sample);
  const Snapshot& snapshot() const;

  /// Forgets every sample and detected fault; keeps registration, options and declared faults.
  void reset();

  const robot::Description& robot() const;
  const std::optional<vision::StereoRig>& rig() const;
  const TrackingOptions& options() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::tracking
