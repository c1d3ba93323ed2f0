#include "core/studies/latency_study.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/yaml.h"
#include "core/experiments/tables.h"
#include "core/identification/delay_passes.h"
#include "core/identification/identification_data.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/interval.h"
#include "core/studies/kept_trials.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::studies {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

/// Source of samples in memory, which can be read repeatedly.
struct Replay {
  const tracking::SourceInfo& about;
  const std::vector<tracking::Sample>& samples;
  std::size_t at = 0;

  const tracking::SourceInfo& info() const { return about; }
  bool next(tracking::Sample& out) {
    if (at == samples.size()) return false;
    out = samples[at++];
    return true;
  }
};

simulation::SimulatedOptions lateRobot(const LatencyStudyOptions& options, double delay, std::uint64_t seed) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.duration = options.duration;
  request.seed = seed;
  request.images = false;
  simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  simulated.truth.cameras.stamp_delay = delay;
  simulated.joint_decimation = 10;
  return simulated;
}

LatencyTrial runTrial(const LatencyStudyOptions& options, const simulation::SimulatedOptions& simulated,
                      base::Progress& progress) {
  LatencyTrial trial;
  const double delay = trial.truth = simulated.truth.cameras.stamp_delay;
  simulation::SimulatedSource source(simulated);
  tracking::SourceInfo info = source.info();
  std::vector<tracking::Sample> samples;
  for (tracking::Sample sample; !progress.cancelled() && source.next(sample);) samples.push_back(sample);

  const identification::ParameterSet set(info.robot, options.parameters);
  identification::CameraPoseOptions camera;
  camera.delay_sigma = options.prior_sigma;
  Replay recording{info, samples};
  const auto data = identification::collect(recording, &progress);
  const auto dual = identification::identifyDualUkfInPasses(data, set, {.camera = camera}, &progress);
  identification::BatchOptions batch_options{.camera = camera, .shooting = {.threads = 1}};
  batch_options.start = identification::logsOf(dual.estimates);
  const auto batch = identification::identifyBatchInPasses(data, set, batch_options, &progress);
  if (progress.cancelled()) return trial;
  trial.delay = {dual.camera.delay, batch.camera.delay};
  trial.sigma = {dual.camera_sigma.delay, batch.camera_sigma.delay};

  info.robot = identification::identifiedRobot(set, batch.estimates);
  const std::array<double, 3> corrections = {0.0, trial.delay[1], delay};
  for (std::size_t i = 0; i < corrections.size(); ++i) {
    tracking::TrackingOptions tracking = tracking::sixState();  // the augmented filter finds delays by itself
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

json jsonOf(const LatencyTrial& trial) {
  json rms = json::array();
  for (const auto& what : trial.rms)
    for (const Vector3d& of : what) rms.push_back({of(0), of(1), of(2)});
  return {{"truth", trial.truth}, {"delay", trial.delay}, {"sigma", trial.sigma}, {"rms", rms}};
}

LatencyTrial trialOf(const json& document, std::uint64_t seed) {
  LatencyTrial trial;
  trial.seed = seed;
  document.at("truth").get_to(trial.truth);
  document.at("delay").get_to(trial.delay);
  document.at("sigma").get_to(trial.sigma);
  for (std::size_t i = 0; i < 9; ++i)
    for (int joint = 0; joint < 3; ++joint)
      trial.rms[i / 3][i % 3](joint) =
          numberOrNan(document.at("rms").at(i).at(static_cast<std::size_t>(joint)));
  return trial;
}

/// Trials grouped by delay, in the order of the options.
std::vector<std::vector<LatencyTrial>> byDelay(const LatencyStudy& study) {
  std::vector<std::vector<LatencyTrial>> groups;
  for (const LatencyTrial& trial : study.trials) {
    if (groups.empty() || groups.back().front().truth != trial.truth) groups.emplace_back();
    groups.back().push_back(trial);
  }
  return groups;
}

}  // namespace

bool LatencyTrial::covered(experiments::Method method) const {
  const auto at = static_cast<std::size_t>(method);
  return std::abs(delay[at] - truth) <= stats::kNormal95 * sigma[at];
}

LatencyStudy runLatencyStudy(const LatencyStudyOptions& options, base::Progress& progress) {
  const auto seeds = static_cast<std::uint64_t>(options.seeds);
  std::vector<KeptTrial> trials;
  for (const double delay : options.delays)
    for (std::uint64_t seed = options.seed; seed < options.seed + seeds; ++seed) {
      const simulation::SimulatedOptions robot = lateRobot(options, delay, seed);
      const json fingerprint = {{"software", options.software},
                                {"seed", seed},
                                {"parameters", options.parameters},
                                {"prior of the delay", options.prior_sigma},
                                {"nominal robot", robot::formatDescription(robot.robot)},
                                {"truth", simulation::formatTruth(robot.truth)},
                                {"trajectory", base::writeYaml(robot.trajectory)}};
      trials.push_back(
          {fmt::format("stamps {:g} ms {}, seed {}", 1e3 * std::abs(delay), delay < 0.0 ? "early" : "late",
                       seed),
           [fingerprint] { return fingerprint; },
           [&options, robot](base::Progress& own) { return jsonOf(runTrial(options, robot, own)); }});
    }
  LatencyStudy study;
  KeptResults kept =
      runKept(trials, experiments::TrialStore(options.out), options.threads, progress, options.part);
  study.notices = std::move(kept.notices);
  study.cancelled = kept.cancelled;
  if (!kept.complete()) return study;
  for (std::size_t i = 0; i < kept.results.size(); ++i)
    study.trials.push_back(trialOf(kept.results[i], options.seed + i % seeds));
  return study;
}

base::Table estimatesOf(const LatencyStudy& study, const LatencyStudyOptions& options) {
  base::Table table;
  table.title = "Delay of the camera's stamps, estimated";
  table.columns = {{"truth", "ms", 1}, {"dual UKF", "ms", 2}, {"± sigma", "ms", 2},  {"inside 95 %", {}, 0},
                   {"batch", "ms", 2}, {"± sigma", "ms", 2},  {"inside 95 %", {}, 0}};
  for (const auto& group : byDelay(study)) {
    std::vector<base::TableCell> row = {1e3 * group.front().truth};
    for (const experiments::Method method : {experiments::Method::kDualUkf, experiments::Method::kBatch}) {
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
      "Simulated block transfers of {:g} s ({} truth), means over {} seed{}. Only motors and cameras are "
      "used. "
      "Prior of the delay: 0 ± {:g} ms. Each method runs a second pass from its own delay where that is "
      "long.",
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
        for (int joint = 0; joint < 3; ++joint) row.emplace_back(experiments::forPeople(rms(joint), joint));
      }
      table.rows.push_back(std::move(row));
    }
  table.note =
      "Corrected: by the batch method's estimate. All rows use the identified robot. Without motors: all "
      "encoders "
      "are declared failed.";
  return table;
}

}  // namespace capstan::studies
