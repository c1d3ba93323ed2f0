#include "core/experiments/track_trial.h"

#include <algorithm>
#include <chrono>

#include "core/base/due_times.h"
#include "core/experiments/motion_collector.h"
#include "core/stats/running_rms.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::experiments {
namespace {

constexpr double kErrorRate = 100.0;  // rate of error points [1/s]

/// Collects the results of a trial from the snapshots of its pipeline.
class TrialListener {
 public:
  TrialListener(const TrialSource& source, TrialResult& result)
      : source_(source), result_(result), motion_(source, result) {}

  void operator()(const tracking::Snapshot& s) {
    if (s.camera_updated) takeCamera(s);
    if (s.reference_paired) takeErrors(s);
    motion_.take(s);
  }

  void finish() {
    for (std::size_t i = 0; i < kEstimators; ++i) {
      result_.rms[i] = rms_[i].value();
      result_.counts[i] = rms_[i].count();
    }
    motion_.finish();
  }

 private:
  stats::RunningRms<3>& rmsOf(Estimator which) { return rms_[static_cast<std::size_t>(which)]; }

  void takeCamera(const tracking::Snapshot& s) {
    if (s.camera_images) result_.images = true;
    if (s.gate == tracking::Gate::kOpen) rmsOf(Estimator::kCamera).add(s.q_link_cam - s.q_link_true_cam);
  }

  void takeErrors(const tracking::Snapshot& s) {
    const Eigen::Vector3d kinematic = motion_.kinematicOf(s) - s.q_link_true;
    const Eigen::Vector3d identified = s.q_link_kin - s.q_link_true;
    const Eigen::Vector3d ukf = s.q_link_ukf - s.q_link_true;
    rmsOf(Estimator::kKinematic).add(kinematic);
    rmsOf(Estimator::kIdentified).add(identified);
    rmsOf(Estimator::kUkf).add(ukf);
    if (errors_due_.due(s.t))
      result_.errors.push_back(
          {roundedTime(s.t), rounded(kinematic), rounded(identified), rounded(ukf), source_.blocked()});
  }

  const TrialSource& source_;
  TrialResult& result_;
  MotionCollector motion_;
  std::array<stats::RunningRms<3>, kEstimators> rms_;
  base::DueTimes errors_due_{kErrorRate};
};

}  // namespace

TrialResult trackTrial(const TrialSetup& setup, base::Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  TrialSource source(setup);
  const tracking::SourceInfo& info = source.info();
  TrialResult result;
  result.name = setup.spec.name;
  result.simulated = setup.recording.empty() || !info.truth.empty();
  if (setup.recording.empty()) result.seed = setup.spec.seed;
  result.occlusion = setup.spec.occlusion;
  result.inputs = source.inputs();
  tracking::TrackingOptions options = tracking::trackingOptionsOf(info);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info, tracking::sixState(options));
  options.filter = tracking::FilterKind::kAugmented;
  tracking::TrackingPipeline augmented = tracking::makePipeline(info, options);
  stats::RunningRms<3> augmented_rms;
  result.inputs.tracking = base::writeYaml(pipeline.options());
  TrialListener listener(source, result);
  const tracking::TrackReport report =
      tracking::trackAll(source, pipeline, &progress, info.duration,
                         [&](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                           listener(snapshot);
                           const tracking::Snapshot& beside = augmented.step(sample);
                           if (beside.reference_paired)
                             augmented_rms.add(beside.q_link_ukf - beside.q_link_true);
                         });
  result.rms_augmented = augmented_rms.value();
  result.reference = info.reference;
  result.own_kinematics = info.own_kinematics;
  result.motor_samples = report.motor_samples;
  result.camera_samples = report.camera_samples;
  // The simulated cameras are never exchanged; files of results keep their form.
  std::ranges::copy_n(report.gates.begin(), static_cast<std::ptrdiff_t>(result.gates.size()),
                      result.gates.begin());
  result.nis = report.nisMean();
  result.nees = report.neesMean();
  result.rescues = report.rescues;
  result.late_dropped = report.late_dropped;
  listener.finish();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace capstan::experiments
