#include "core/experiments/track_trial.h"

#include <chrono>
#include <cmath>

#include "core/robot/transmission.h"
#include "core/session/due_times.h"
#include "core/stats/running_rms.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::experiments {
namespace {

constexpr double kTrajectoryRate = 20.0, kErrorRate = 100.0;  // [1/s]

double roundedTime(double t) { return std::round(t * 1e6) / 1e6; }
/// To 1e-9 by division, so that the decimals are short.
Eigen::Vector3d rounded(const Eigen::Vector3d& joints) {
  return joints.unaryExpr([](double value) { return std::round(value * 1e9) / 1e9; });
}

/// Listens to the pipeline.
class TrialListener {
 public:
  TrialListener(const TrialSource& source, TrialResult& result)
      : source_(source),
        result_(result),
        nominal_(source.nominal()),
        reference_(source.info().reference || source.info().own_kinematics) {}

  void operator()(const tracking::Snapshot& s) {
    if (s.motor_updated && source_.blocked()) ++blocked_samples_;
    if (s.camera_updated) takeCamera(s);
    if (s.reference_paired) takeErrors(s);
    if (reference_ ? s.reference_paired : s.motor_updated) takePoint(s);
  }

  void finish() {
    for (std::size_t i = 0; i < kEstimators; ++i) {
      result_.rms[i] = rms_[i].value();
      result_.counts[i] = rms_[i].count();
    }
    if (result_.motor_samples > 0)
      result_.occluded_share =
          static_cast<double>(blocked_samples_) / static_cast<double>(result_.motor_samples);
  }

 private:
  stats::RunningRms<3>& rmsOf(Estimator which) { return rms_[static_cast<std::size_t>(which)]; }
  Eigen::Vector3d kinematicOf(const tracking::Snapshot& s) const {
    return nominal_.jointFromMotor(s.q_motor);
  }

  void takeCamera(const tracking::Snapshot& s) {
    if (s.camera_images) result_.images = true;
    if (s.gate != tracking::Gate::kOpen) return;
    const Eigen::Vector3d error = s.q_link_cam - s.q_link_true_cam;
    rmsOf(Estimator::kCamera).add(error);
    seen_ = s.q_link_cam;
    result_.camera.push_back({roundedTime(s.t_cam), rounded(s.q_link_cam), rounded(error)});
  }

  void takeErrors(const tracking::Snapshot& s) {
    const Eigen::Vector3d kinematic = kinematicOf(s) - s.q_link_true;
    const Eigen::Vector3d identified = s.q_link_kin - s.q_link_true;
    const Eigen::Vector3d ukf = s.q_link_ukf - s.q_link_true;
    rmsOf(Estimator::kKinematic).add(kinematic);
    rmsOf(Estimator::kIdentified).add(identified);
    rmsOf(Estimator::kUkf).add(ukf);
    if (errors_due_.due(s.t))
      result_.errors.push_back(
          {roundedTime(s.t), rounded(kinematic), rounded(identified), rounded(ukf), source_.blocked()});
  }

  void takePoint(const tracking::Snapshot& s) {
    if (!trajectory_due_.due(s.t)) return;
    TrajectoryPoint point;
    point.t = roundedTime(s.t);
    if (reference_) point.q_true = rounded(s.q_link_true);
    point.q_kin = rounded(kinematicOf(s));
    point.q_cam = rounded(seen_);
    point.q_ukf = rounded(s.q_link_ukf);
    point.sigma = rounded(s.q_link_ukf_sigma);
    point.occluded = source_.blocked();
    result_.trajectory.push_back(point);
    seen_ = noJoints();
  }

  const TrialSource& source_;
  TrialResult& result_;
  robot::Transmission nominal_;
  bool reference_;
  std::array<stats::RunningRms<3>, kEstimators> rms_;
  session::DueTimes trajectory_due_{kTrajectoryRate}, errors_due_{kErrorRate};
  Eigen::Vector3d seen_ = noJoints();
  std::uint64_t blocked_samples_ = 0;
};

}  // namespace

TrialResult trackTrial(const TrialSetup& setup, base::Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  TrialSource source(setup);
  const session::SourceInfo& info = source.info();
  TrialResult result;
  result.name = setup.spec.name;
  result.simulated = setup.recording.empty() || !info.truth.empty();
  if (setup.recording.empty()) result.seed = setup.spec.seed;
  result.occlusion = setup.spec.occlusion;
  result.inputs = source.inputs();
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info);
  result.inputs.tracking = base::writeYaml(pipeline.options());
  TrialListener listener(source, result);
  const tracking::TrackReport report = tracking::trackAll(
      source, pipeline, &progress, info.duration,
      [&](const tracking::Sample&, const tracking::Snapshot& snapshot) { listener(snapshot); });
  result.reference = info.reference;
  result.own_kinematics = info.own_kinematics;
  result.begin = report.first_t;
  result.end = report.last_t;
  result.motor_samples = report.motor_samples;
  result.camera_samples = report.camera_samples;
  result.gates = report.gates;
  result.nis = report.nisMean();
  result.nees = report.neesMean();
  result.rescues = report.rescues;
  result.late_dropped = report.late_dropped;
  listener.finish();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace capstan::experiments
