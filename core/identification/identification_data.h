#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/progress.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/description.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::identification {

/// Shortest time without motor samples after which every method restarts [s].
inline constexpr double kMotorGap = 0.05;

/// Motor encoder samples, times increasing: t [s], q_m from the hard stop [rad], dq_m [rad/s].
struct MotorTrack {
  std::vector<double> t;
  std::vector<Eigen::Vector3d> position, velocity;

  std::size_t size() const { return t.size(); }
  /// Index of the last sample at or before `time`; 0 where there is none.
  std::size_t at(double time) const;
};

/// Observation of the tip by the cameras at one exposure.
struct CameraObservation {
  double t = 0.0;                  ///< time of exposure by the camera's clock [s]
  Eigen::Vector3d tip;             ///< observed tip in frame 0 by the recording's registration [m]
  Eigen::Vector3d tip_kin;         ///< tip by transmission kinematics at t [m]
  Eigen::Matrix3d tip_covariance;  ///< covariance of `tip` by the measurement noise [m²]
  Eigen::Vector3d q_cam;           ///< inverse kinematics of `tip` [rad, rad, m]
  Eigen::Matrix3d q_covariance;  ///< covariance J⁻¹ tip_covariance J⁻ᵀ of q_cam; no minimum is imposed,
                                 ///< unlike in tracking
  bool open = false;  ///< true: a marker near the kinematic tip; else the observation is not used
};

/// Data of a recording for identification: motors and cameras, without joint encoders.
struct IdentificationData {
  std::string title;
  robot::Description robot;  ///< nominal robot
  MotorTrack motors;
  std::vector<CameraObservation> cameras;  ///< times increasing
  /// Measured standard deviation of the observations / stated one (measureNoise()).
  double noise_ratio = 1.0;
  bool images = false;  ///< true: markers were found in images
  /// Number of motor samples excluded because an encoder gave no number or had failed (DataCollector).
  std::uint64_t excluded = 0;
  bool cancelled = false;

  std::size_t openCount() const;  ///< number of observations in use
  double duration() const { return motors.t.empty() ? 0.0 : motors.t.back() - motors.t.front(); }
};

/// Measures the camera noise in the recording and sets the observations' covariances to it. Camera noise is
/// white, and all other differences between camera and transmission kinematics are slow. So the second
/// difference of tip − tip_kin over three successive frames has six times the variance of the noise.
/// Covariances from pixels are scaled by one factor: the median normalized square over the χ² median. For
/// tips that were not computed from images, the covariance is only an assumption in the options of the
/// pipeline. The measured covariance replaces it (squares beyond the 99.9 % quantile excluded). q_covariance
/// follows. With fewer than 30 triples nothing changes.
void measureNoise(IdentificationData& data);

/// Appends `more`, a recording of the same robot and rig, to `data`, one second after its end. This gap in
/// the motor samples makes every method restart.
void append(IdentificationData& data, const IdentificationData& more);

/// True when every motor encoder gives a number and has not failed, so that q_link_kin is valid.
inline bool motorsKnown(const tracking::Snapshot& s) {
  return !tracking::anyMotorFailed(s) && s.q_link_kin.allFinite();
}

/// Collects IdentificationData from samples and the pipeline's snapshots of them, in order of arrival.
///
/// Where an encoder failed or gives no number, the recording has a gap: no motor sample and no camera
/// observation. A frozen encoder is detected with delay; its gap begins where its count last moved by more
/// than an encoder step.
class DataCollector {
 public:
  DataCollector(const tracking::TrackingPipeline& pipeline, std::string title);
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot);
  /// Returns the data in order of time, with measured noise.
  IdentificationData finish();

 private:
  void addMotors(const tracking::Snapshot& snapshot);
  void excludeFrozen(const tracking::Snapshot& snapshot);

  IdentificationData data_;
  std::uint64_t taken_ = 0;  ///< number of motor samples that the pipeline accepted
  std::array<tracking::MotorFault, 3> failed_{};
  robot::ArmKinematics arm_;
  std::optional<Eigen::Isometry3d> base_from_camera_;
  Eigen::Vector3d tip_sigma_, jump_tolerance_;
};

/// Runs the tracking pipeline over `source` (tracking::Source or any type with info() and next()) and returns
/// its motor and stereo-vision data; joint encoder samples are ignored. `each(sample, snapshot)` is called
/// for every sample. Throws base::InputError unless the robot is a three-joint remote-centre arm.
template <class Source, class Each = tracking::IgnoreSnapshots>
IdentificationData collect(Source& source, base::Progress* progress = nullptr, Each each = {}) {
  const auto& info = source.info();
  tracking::TrackingPipeline pipeline =
      tracking::makePipeline(info, tracking::sixState(tracking::trackingOptionsOf(info)));
  DataCollector collector(pipeline, info.title);
  const auto report =
      tracking::trackAll(source, pipeline, progress, info.duration,
                         [&](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                           collector.add(sample, snapshot);
                           each(sample, snapshot);
                         });
  IdentificationData data = collector.finish();
  data.cancelled = report.cancelled;
  return data;
}

}  // namespace capstan::identification
