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

/// The tracking pipeline: takes samples and returns snapshots. Deterministic, single-threaded, without
/// allocations after the first samples.
/// - motors → transmission kinematics → q_kin; the filter predicts [q_l, dq_l] (UKF paper (10)) at the motor
/// rate
/// - frames → marker in each region of interest → triangulation → base frame → inverse kinematics → q_cam
/// - q_cam (q_kin while the gate is closed) → square-root UKF update, at the time of exposure → q_ukf
///
/// The gate closes when a marker is missing, the tip is out of reach, or the innovation lies beyond the χ²
/// gate (a jump). A jump ends when the innovation is back inside the gate, or when `jump_samples` successive
/// camera samples agree on q_cam − q_kin within their noise and `jump_drift`: the observed marker then moves
/// with the motors, so it is the tip, and the filter was wrong. After `missing_after` periods without a
/// camera sample, the filter observes q_kin at the camera's rate.
///
/// When a motor encoder fails (EncoderWatch), the filter models its joint by a random acceleration
/// (UnknownMotion). The camera and, through the coupling, the cables of the other motors observe the joint.
/// The failed motor's part of q_kin is not observed; regions of interest, the branch of the inverse
/// kinematics and the jump gate use the estimate in its place. During occlusion sigma grows with the possible
/// motion of the joint.
///
/// The pipeline compensates the effects of a robot file: effects of motor readings and cameras are removed
/// from incoming samples (MotorReading, robot::CameraNumbers); the others are part of the filter's model.
class TrackingPipeline {
 public:
  /// Creates a pipeline for a three-joint remote-centre arm; only frames need `rig`. Throws base::InputError
  /// for a robot of another kind.
  TrackingPipeline(const robot::Description& robot, std::optional<vision::StereoRig> rig,
                   const vision::MarkerOptions& marker, const TrackingOptions& options);
  ~TrackingPipeline();
  TrackingPipeline(TrackingPipeline&&) noexcept;
  TrackingPipeline& operator=(TrackingPipeline&&) noexcept;

  /// Sets the registration; frames then give q_cam. Without registration markers are searched in the whole
  /// frame, tip_in_camera is computed, and the filter observes q_kin (gate kUnregistered).
  void setRegistration(const Eigen::Isometry3d& base_from_camera);
  const std::optional<Eigen::Isometry3d>& registration() const;

  /// States that joint samples are the robot's own kinematics (SourceInfo::own_kinematics), which is no
  /// truth.
  void setOwnKinematics(bool own);

  /// Looks for another marker from the next images on.
  void setMarker(const vision::MarkerOptions& marker);

  /// Declares the encoder of motor 0, 1 or 2 failed (it is ignored) or working (it is used again), whatever
  /// was detected.
  void setMotorFailed(int motor, bool failed);

  /// Takes one sample, in order of arrival. The reference stays valid until the next call. Never throws.
  const Snapshot& step(const Sample& sample);
  const Snapshot& snapshot() const;

  /// Forgets all samples and detected faults; keeps registration, options and declared faults.
  void reset();

  const robot::Description& robot() const;
  const std::optional<vision::StereoRig>& rig() const;
  const TrackingOptions& options() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::tracking
