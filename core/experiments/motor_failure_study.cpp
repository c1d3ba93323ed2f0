#include "core/experiments/motor_failure_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/base/units.h"
#include "core/experiments/paced_transfer.h"
#include "core/experiments/true_radii.h"
#include "core/experiments/workers.h"
#include "core/session/blocking.h"
#include "core/session/motor_failures.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/quantile.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::experiments {
namespace {

using Eigen::Vector3d;
using tracking::MotorFault;

constexpr int kCases = 4;        // motor 1, 2, 3, all
constexpr double kWindow = 2.0;  // [s], an interval of occlusion
constexpr double kFactor = 2.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool concerns(int motor, int joint) { return motor == 3 || motor == joint; }

/// One pipeline's errors over a trial.
struct Run {
  tracking::TrackingPipeline pipeline;
  session::MotorFailures failures;
  std::vector<double> t;
  std::vector<Vector3d> error;
  double nees = 0.0, found = kNan;
  std::uint64_t paired = 0;

  void take(tracking::Sample sample, double failure) {
    if (auto* motor = std::get_if<tracking::MotorSample>(&sample)) failures.apply(*motor);
    const tracking::Snapshot& s = pipeline.step(sample);
    if (std::isnan(found) && s.t >= failure && tracking::anyMotorFailed(s)) found = s.t - failure;
    if (!s.reference_paired) return;
    t.push_back(s.t);
    error.push_back(s.q_link_ukf - s.q_link_true);
    if (s.t < failure) return;
    nees += s.nees / 3.0;
    ++paired;
  }
  Vector3d rmsFrom(double failure) const {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      if (t[i] >= failure) sum += error[i].cwiseAbs2(), ++count;
    return (sum / std::max(count, 1)).cwiseSqrt();
  }
};

std::vector<session::MotorFailure> failuresOf(int which, const MotorFailureStudyOptions& options) {
  std::vector<session::MotorFailure> failures;
  for (int motor = 0; motor < 3; ++motor)
    if (concerns(which, motor)) failures.push_back({motor, options.warm_up, options.fault});
  return failures;
}

/// Time and share within kFactor of the normal RMS, over a sliding window.
void judge(const Run& run, double failure, double end, MotorFailureResult& result) {
  Vector3d sum = Vector3d::Zero();
  std::size_t oldest = 0;
  std::uint64_t within = 0, all = 0;
  double first = kNan;
  for (std::size_t i = 0; i < run.t.size(); ++i) {
    sum += run.error[i].cwiseAbs2();
    for (; run.t[i] - run.t[oldest] > kWindow; ++oldest) sum -= run.error[oldest].cwiseAbs2();
    if (run.t[i] < failure) continue;
    const Vector3d rms = (sum / static_cast<double>(i - oldest + 1)).cwiseMax(0.0).cwiseSqrt();
    bool exceeded = false;
    for (int joint = 0; joint < 3; ++joint)
      exceeded |= concerns(result.motor, joint) && rms(joint) > kFactor * result.normal_rms(joint);
    if (exceeded && std::isnan(first)) first = run.t[i] - failure;
    within += exceeded ? 0 : 1;
    ++all;
  }
  result.whole = std::isnan(first) ? 1 : 0;
  result.held = std::isnan(first) ? end - failure : first;
  result.share = all == 0 ? kNan : static_cast<double>(within) / static_cast<double>(all);
}

using TrialResults = std::array<MotorFailureResult, kCases>;

TrialResults runTrial(const MotorFailureStudyOptions& options, double speed, double occlusion,
                      std::uint64_t seed, base::Progress& progress) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.seed = seed;
  request.images = options.images;
  simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  const double length = options.warm_up + options.duration;
  const PacedTransfer path(simulated.robot, speed, length, seed);
  simulated.trajectory.kind = simulation::TrajectoryKind::kRecorded;
  simulated.trajectory.recorded.file = path.file().string();
  simulated.joint_decimation = 10;
  simulation::SimulatedSource source(simulated);
  session::SourceInfo info = source.info();
  if (options.true_radii) info.robot = withTrueRadii(info.robot, simulated.truth);
  std::deque<Run> runs;
  runs.push_back({tracking::makePipeline(info), session::MotorFailures({}), {}, {}});
  for (int which = 0; which < kCases; ++which)
    runs.push_back(
        {tracking::makePipeline(info), session::MotorFailures(failuresOf(which, options)), {}, {}});
  session::Blocking blocking;
  blocking.setSchedule({.percentage = occlusion, .interval = kWindow, .start = options.warm_up});
  tracking::Sample sample;
  double t = 0.0;
  for (std::uint64_t count = 0; !progress.cancelled(); ++count) {
    blocking.apply(t, source);
    if (!source.next(sample)) break;
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) t = motor->t;
    for (Run& run : runs) run.take(sample, options.warm_up);
    if (count % 4096 == 0) progress.report(std::min(1.0, t / length), "tracking");
  }
  TrialResults results;
  for (int which = 0; which < kCases; ++which) {
    const Run& run = runs[static_cast<std::size_t>(which) + 1];
    MotorFailureResult& result = results[static_cast<std::size_t>(which)];
    result.motor = which;
    result.speed = speed;
    result.occlusion = occlusion;
    result.normal_rms = runs.front().rmsFrom(options.warm_up);
    result.failed_rms = run.rmsFrom(options.warm_up);
    result.found = run.found;
    result.nees = run.paired == 0 ? kNan : run.nees / static_cast<double>(run.paired);
    judge(run, options.warm_up, t, result);
  }
  return results;
}

MotorFailureResult over(const std::vector<MotorFailureResult>& seeds) {
  MotorFailureResult all = seeds.front();
  all.whole = 0;
  all.share = all.nees = 0.0;
  Vector3d normal = Vector3d::Zero(), failed = Vector3d::Zero();
  std::vector<double> held, found;
  for (const MotorFailureResult& one : seeds) {
    const double weight = 1.0 / static_cast<double>(seeds.size());
    normal += weight * one.normal_rms.cwiseAbs2();
    failed += weight * one.failed_rms.cwiseAbs2();
    all.share += weight * one.share;
    all.nees += weight * one.nees;
    all.whole += one.whole;
    held.push_back(one.held);
    if (!std::isnan(one.found)) found.push_back(one.found);
  }
  all.normal_rms = normal.cwiseSqrt();
  all.failed_rms = failed.cwiseSqrt();
  all.held = stats::median(held);
  all.found = found.size() == seeds.size() ? stats::median(found) : kNan;
  return all;
}

std::string rmsText(const MotorFailureResult& cell) {
  const Vector3d& rms = cell.failed_rms;
  const std::array<std::string, 3> all = {fmt::format("{:.2f}°", base::toDegrees(rms(0))),
                                          fmt::format("{:.2f}°", base::toDegrees(rms(1))),
                                          fmt::format("{:.1f} mm", base::toMillimetres(rms(2)))};
  if (cell.motor == 3) return all[0] + " " + all[1] + " " + all[2];
  return all[static_cast<std::size_t>(cell.motor)];
}

std::string motorName(int motor) { return motor == 3 ? std::string("all") : fmt::format("{}", motor + 1); }

}  // namespace

double MotorFailureResult::ratio() const {
  double largest = 0.0;
  for (int joint = 0; joint < 3; ++joint)
    if (concerns(motor, joint)) largest = std::max(largest, failed_rms(joint) / normal_rms(joint));
  return largest;
}

MotorFailureStudy runMotorFailureStudy(const MotorFailureStudyOptions& options, base::Progress& progress) {
  const auto seeds = static_cast<std::size_t>(options.seeds);
  const std::size_t places = options.speeds.size() * options.occlusions.size();
  std::vector<TrialResults> trials(places * seeds);
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const double speed = options.speeds[i / seeds / options.occlusions.size()];
    const double occlusion = options.occlusions[i / seeds % options.occlusions.size()];
    jobs.push_back({fmt::format("speed {:g}, {:g} % occluded", speed, occlusion), 1.0,
                    [&, i, speed, occlusion](base::Progress& own) {
                      trials[i] = runTrial(options, speed, occlusion, options.seed + i % seeds, own);
                    }});
  }
  doAll(jobs, options.threads, {progress});
  MotorFailureStudy study;
  study.cancelled = progress.cancelled();
  if (study.cancelled) return study;
  for (std::size_t which = 0; which < kCases; ++which)
    for (std::size_t place = 0; place < places; ++place) {
      std::vector<MotorFailureResult> of;
      for (std::size_t s = 0; s < seeds; ++s) of.push_back(trials[place * seeds + s][which]);
      study.cells.push_back(over(of));
    }
  return study;
}

base::Table mapOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options) {
  base::Table table;
  table.title = fmt::format("Motor encoder {}: time within twice the normal error, failed by normal RMS, RMS",
                            base::nameOf(options.fault));
  table.columns = {{"motor", {}, 0}, {"speed", {}, 2}};
  for (const double occlusion : options.occlusions)
    table.columns.push_back({fmt::format("{:g} % occluded", occlusion), {}, 0});
  for (std::size_t i = 0; i < study.cells.size(); i += options.occlusions.size()) {
    std::vector<base::TableCell> row = {motorName(study.cells[i].motor), study.cells[i].speed};
    for (std::size_t k = 0; k < options.occlusions.size(); ++k) {
      const MotorFailureResult& cell = study.cells[i + k];
      row.push_back(
          (cell.whole == options.seeds ? std::string("whole trial") : fmt::format("{:.1f} s", cell.held)) +
          fmt::format(", ×{:.1f}, {}", cell.ratio(), rmsText(cell)));
    }
    table.rows.push_back(std::move(row));
  }
  table.note = fmt::format(
      "Simulated robot ({} truth, {} radii in the filter), {} seed{} of {:g} s from the failure on; error: "
      "RMS over the last 2 s of a failed joint, median over seeds; speed: by the pace of a 200 s block "
      "transfer.",
      options.truth, options.true_radii ? "true" : "nominal", options.seeds, options.seeds == 1 ? "" : "s",
      options.duration);
  return table;
}

base::Table detailsOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options) {
  base::Table table;
  table.title = "Motor encoder failure, all numbers";
  table.columns = {
      {"motor", {}, 0},        {"speed", {}, 2},        {"occluded", "%", 0},   {"held", "s", 2},
      {"share within", {}, 3}, {"whole trials", {}, 0}, {"seeds", {}, 0},       {"found after", "s", 3},
      {"normal q1", "deg", 4}, {"normal q2", "deg", 4}, {"normal q3", "mm", 4}, {"failed q1", "deg", 4},
      {"failed q2", "deg", 4}, {"failed q3", "mm", 4},  {"ratio", {}, 2},       {"NEES / 3", {}, 3}};
  for (const MotorFailureResult& cell : study.cells) {
    std::vector<base::TableCell> row = {motorName(cell.motor),
                                        cell.speed,
                                        cell.occlusion,
                                        cell.held,
                                        cell.share,
                                        static_cast<double>(cell.whole),
                                        static_cast<double>(options.seeds),
                                        cell.found};
    for (const Vector3d& rms : {cell.normal_rms, cell.failed_rms})
      for (int joint = 0; joint < 3; ++joint)
        row.emplace_back(joint == 2 ? base::toMillimetres(rms(joint)) : base::toDegrees(rms(joint)));
    row.emplace_back(cell.ratio());
    row.emplace_back(cell.nees);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace capstan::experiments
