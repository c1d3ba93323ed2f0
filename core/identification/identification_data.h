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

/// Time without motor samples from which on every method restarts: the arm was lost [s].
inline constexpr double kMotorGap = 0.05;

/// Motor encoders in rising time: t [s], q_m from the hard stop [rad], dq_m [rad/s].
struct MotorTrack {
  std::vector<double> t;
  std::vector<Eigen::Vector3d> position, velocity;

  std::size_t size() const { return t.size(); }
  /// Index of the last sample at or before `time`; 0 where there is none.
  std::size_t at(double time) const;
};

/// What the cameras saw of the tip at one exposure.
struct CameraObservation {
  double t = 0.0;                  ///< exposure, by the camera's stamp [s]
  Eigen::Vector3d tip;             ///< in frame 0, through the recording's registration [m]
  Eigen::Vector3d tip_kin;         ///< tip of transmission kinematics at t [m]
  Eigen::Matrix3d tip_covariance;  ///< of the pixel noise [m²]
  Eigen::Vector3d q_cam;           ///< inverse kinematics of `tip` [rad, rad, m]
  Eigen::Matrix3d q_covariance;    ///< J⁻¹ tip_covariance J⁻ᵀ, without any floor
  bool open = false;               ///< a marker near the kinematic tip; others are not used
};

/// A recording as identification needs it. Joint encoders are no part of it.
struct IdentificationData {
  std::string title;
  robot::Description robot;  ///< nominal
  MotorTrack motors;
  std::vector<CameraObservation> cameras;  ///< in rising time
  /// Standard deviation of the observations as found, by the one stated (measureNoise()); 1 where they agree.
  double noise_ratio = 1.0;
  bool images = false;  ///< markers were found in pictures
  /// Motor samples excluded because an encoder gave no number, or had failed (DataCollector).
  std::uint64_t excluded = 0;
  bool cancelled = false;

  std::size_t openCount() const;
  double duration() const { return motors.t.empty() ? 0.0 : motors.t.back() - motors.t.front(); }
};

/// Sets the observations' covariances by what the recording itself shows. Camera noise is white and all else
/// between camera and transmission kinematics is slow, so the second difference of tip − tip_kin over three
/// successive frames is six times the noise and little else. Covariances that come from pixels are scaled by
/// one factor, the median normalised square over its χ² median; those of tips without pixels, a mere option
/// of the pipeline, are replaced by the covariance measured (squares beyond the 99.9 % quantile excluded).
/// q_covariance follows. With fewer than 30 triples nothing changes.
void measureNoise(IdentificationData& data);

/// Puts `more` behind `data`, as if it had been recorded a second later: the same robot and rig. The gap in
/// the motor samples makes every method restart there.
void append(IdentificationData& data, const IdentificationData& more);

/// Every motor's encoder gives a number and has not failed: q_link_kin is all transmission kinematics.
inline bool motorsKnown(const tracking::Snapshot& s) {
  return !tracking::anyMotorFailed(s) && s.q_link_kin.allFinite();
}

/// Takes samples and the pipeline's opinion of them, in order of arrival.
///
/// Where a motor is not known, because its encoder failed or gives no number, the recording has a gap: no
/// motor sample and no camera observation. An encoder that is found frozen stood still before that was known;
/// the gap begins where its count last moved by more than an encoder's step.
class DataCollector {
 public:
  DataCollector(const tracking::TrackingPipeline& pipeline, std::string title);
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot);
  /// The record, in order of time, its noise measured.
  IdentificationData finish();

 private:
  void addMotors(const tracking::Snapshot& snapshot);
  void excludeFrozen(const tracking::Snapshot& snapshot);

  IdentificationData data_;
  std::uint64_t taken_ = 0;  ///< motor samples, by the pipeline
  std::array<tracking::MotorFault, 3> failed_{};
  robot::ArmKinematics arm_;
  std::optional<Eigen::Isometry3d> base_from_camera_;
  Eigen::Vector3d tip_sigma_, jump_tolerance_;
};

/// Runs the tracking pipeline over `source` (tracking::Source or anything with info() and next()) and keeps
/// what identification needs: motors and stereo vision. Joint encoder samples are passed over. `each(sample,
/// snapshot)` sees every step besides. Throws base::InputError for a robot that is no three-joint
/// remote-centre arm.
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
