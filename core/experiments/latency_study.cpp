#include "core/experiments/latency_study.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.h"
#include "core/base/yaml.h"
#include "core/experiments/workers.h"
#include "core/identification/batch.h"
#include "core/identification/dual_ukf.h"
#include "core/identification/identification_data.h"
#include "core/simulation/simulation_request.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::experiments {
namespace {

using Eigen::Vector3d;

/// Samples in memory, as often as wanted.
struct Replay {
  const session::SourceInfo& about;
  const std::vector<tracking::Sample>& samples;
  std::size_t at = 0;

  const session::SourceInfo& info() const { return about; }
  bool next(tracking::Sample& out) {
    if (at == samples.size()) return false;
    out = samples[at++];
    return true;
  }
};

LatencyTrial runTrial(const LatencyStudyOptions& options, double delay, std::uint64_t seed,
                      base::Progress& progress) {
  LatencyTrial trial;
  trial.truth = delay;
  trial.seed = seed;
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.duration = options.duration;
  request.seed = seed;
  request.images = false;
  simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  simulated.truth.cameras.stamp_delay = delay;
  simulated.joint_decimation = 10;
  simulation::SimulatedSource source(simulated);
  session::SourceInfo info = source.info();
  std::vector<tracking::Sample> samples;
  for (tracking::Sample sample; !progress.cancelled() && source.next(sample);) samples.push_back(sample);

  const identification::ParameterSet set(info.robot, options.parameters);
  identification::CameraPoseOptions camera;
  camera.delay_sigma = options.prior_sigma;
  identification::DualUkfReport dual;
  identification::BatchReport batch;
  for (int pass = 0; pass < 2; ++pass) {  // the delay acts to first order only: again from where it led
    tracking::TrackingOptions tracking;
    tracking.camera_delay = trial.delay[1];
    info.tracking = base::writeYaml(tracking);
    Replay recording{info, samples};
    const auto data = identification::collect(recording, &progress);
    dual = identification::identifyDualUkf(data, set, {.camera = camera}, &progress);
    identification::BatchOptions batch_options{.camera = camera, .shooting = {.threads = 1}};
    for (const auto& estimate : dual.estimates) batch_options.start.push_back(estimate.log);
    batch = identification::identifyBatch(data, set, batch_options, &progress);
    if (progress.cancelled()) return trial;
    trial.delay = {tracking.camera_delay + dual.camera.delay, tracking.camera_delay + batch.camera.delay};
    trial.sigma = {dual.camera_sigma.delay, batch.camera_sigma.delay};
  }

  info.robot = identification::identifiedRobot(set, batch.estimates);
  const std::array<double, 3> corrections = {0.0, trial.delay[1], delay};
  for (std::size_t i = 0; i < corrections.size(); ++i) {
    tracking::TrackingOptions tracking;
    tracking.camera_delay = corrections[i];
    for (const bool motors : {true, false}) {
      tracking::TrackingPipeline pipeline = tracking::makePipeline(info, tracking);
      for (int motor = 0; motor < 3 && !motors; ++motor) pipeline.setMotorFailed(motor, true);
      Replay again{info, samples};
      const auto errors = tracking::trackAll(again, pipeline, &progress).errors;
      trial.rms[motors ? 0 : 2][i] = errors.ukf().value();
      if (motors) trial.rms[1][i] = errors.camera().value();
    }
  }
  return trial;
}

/// Trials by delay, in the order of the options.
std::vector<std::vector<LatencyTrial>> byDelay(const LatencyStudy& study) {
  std::vector<std::vector<LatencyTrial>> groups;
  for (const LatencyTrial& trial : study.trials) {
    if (groups.empty() || groups.back().front().truth != trial.truth) groups.emplace_back();
    groups.back().push_back(trial);
  }
  return groups;
}

}  // namespace

bool LatencyTrial::covered(Method method) const {
  const auto at = static_cast<std::size_t>(method);
  return std::abs(delay[at] - truth) <= 1.959964 * sigma[at];
}

LatencyStudy runLatencyStudy(const LatencyStudyOptions& options, base::Progress& progress) {
  const auto seeds = static_cast<std::size_t>(options.seeds);
  LatencyStudy study;
  study.trials.resize(options.delays.size() * seeds);
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < study.trials.size(); ++i)
    jobs.push_back({fmt::format("stamps {:+g} ms late", 1e3 * options.delays[i / seeds]), 1.0,
                    [&, i](base::Progress& own) {
                      study.trials[i] =
                          runTrial(options, options.delays[i / seeds], options.seed + i % seeds, own);
                    }});
  doAll(jobs, options.threads, {progress});
  study.cancelled = progress.cancelled();
  if (study.cancelled) study.trials.clear();
  return study;
}

base::Table estimatesOf(const LatencyStudy& study, const LatencyStudyOptions& options) {
  base::Table table;
  table.title = "Delay of the camera's stamps, estimated";
  table.columns = {{"truth", "ms", 1}, {"dual UKF", "ms", 2}, {"± sigma", "ms", 2},  {"inside 95 %", {}, 0},
                   {"batch", "ms", 2}, {"± sigma", "ms", 2},  {"inside 95 %", {}, 0}};
  for (const auto& group : byDelay(study)) {
    std::vector<base::TableCell> row = {1e3 * group.front().truth};
    for (const Method method : {Method::kDualUkf, Method::kBatch}) {
      const auto at = static_cast<std::size_t>(method);
      double delay = 0.0, sigma = 0.0;
      int covered = 0;
      for (const LatencyTrial& trial : group) {
        delay += trial.delay[at] / static_cast<double>(group.size());
        sigma += trial.sigma[at] / static_cast<double>(group.size());
        covered += trial.covered(method) ? 1 : 0;
      }
      row.emplace_back(1e3 * delay);
      row.emplace_back(1e3 * sigma);
      row.emplace_back(fmt::format("{} of {}", covered, group.size()));
    }
    table.rows.push_back(std::move(row));
  }
  table.note = fmt::format(
      "Simulated block transfers of {:g} s ({} truth), means over {} seed{}; nothing but motors and cameras "
      "is "
      "used; prior of the delay: 0 ± {:g} ms.",
      options.duration, options.truth, options.seeds, options.seeds == 1 ? "" : "s",
      1e3 * options.prior_sigma);
  return table;
}

base::Table gainOf(const LatencyStudy& study, const LatencyStudyOptions&) {
  base::Table table;
  table.title = "RMS error of joints with late stamps";
  table.columns = {{"truth", "ms", 1}, {"of", {}, 0}};
  for (const char* how : {"as stamped", "corrected", "true delay"})
    for (int joint = 0; joint < 3; ++joint)
      table.columns.push_back({fmt::format("q{} {}", joint + 1, how), joint == 2 ? "mm" : "deg", 4});
  const std::array<const char*, 3> names = {"UKF", "camera", "UKF without motors"};
  for (const auto& group : byDelay(study))
    for (std::size_t what = 0; what < names.size(); ++what) {
      std::vector<base::TableCell> row = {1e3 * group.front().truth, names[what]};
      for (std::size_t i = 0; i < 3; ++i) {
        Vector3d square = Vector3d::Zero();
        for (const LatencyTrial& trial : group)
          square += trial.rms[what][i].cwiseAbs2() / static_cast<double>(group.size());
        const Vector3d rms = square.cwiseSqrt();
        for (int joint = 0; joint < 3; ++joint)
          row.emplace_back(joint == 2 ? base::toMillimetres(rms(joint)) : base::toDegrees(rms(joint)));
      }
      table.rows.push_back(std::move(row));
    }
  table.note =
      "Corrected by the batch method's estimate; the robot is the identified one in all of them. Without "
      "motors: all encoders declared failed.";
  return table;
}

}  // namespace capstan::experiments
