#include "core/studies/motor_failure_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/base/units.h"
#include "core/experiments/tables.h"
#include "core/live/motor_failures.h"
#include "core/live/occluded_source.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/quantile.h"
#include "core/studies/kept_trials.h"
#include "core/studies/transfer_at_rate.h"
#include "core/studies/true_radii.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::studies {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using tracking::MotorFault;

constexpr int kCases = 4;        // failures of motor 1, 2, 3, all
constexpr double kWindow = 2.0;  // window of the RMS, and interval of occlusion [s]
constexpr double kFactor = 2.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool concerns(int motor, int joint) { return motor == 3 || motor == joint; }

/// Errors of one pipeline over a trial.
struct Run {
  tracking::TrackingPipeline pipeline;
  live::MotorFailures failures;
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

std::vector<live::MotorFailure> failuresOf(int which, const MotorFailureStudyOptions& options) {
  std::vector<live::MotorFailure> failures;
  for (int motor = 0; motor < 3; ++motor)
    if (concerns(which, motor)) failures.push_back({motor, options.warm_up, options.fault});
  return failures;
}

/// Endurance of the joints of `motor`: time and share within kFactor times the RMS `normal`, over a sliding
/// window.
Endurance judge(const Run& run, double failure, double end, int motor, const Vector3d& normal) {
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
      exceeded |= concerns(motor, joint) && rms(joint) > kFactor * normal(joint);
    if (exceeded && std::isnan(first)) first = run.t[i] - failure;
    within += exceeded ? 0 : 1;
    ++all;
  }
  return {.held = std::isnan(first) ? end - failure : first,
          .share = all == 0 ? kNan : static_cast<double>(within) / static_cast<double>(all),
          .whole = std::isnan(first) ? 1 : 0};
}

using TrialResults = std::array<MotorFailureResult, kCases>;

simulation::SimulatedOptions robotOf(const MotorFailureStudyOptions& options, std::uint64_t seed) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.seed = seed;
  request.images = options.images;
  return simulation::optionsOf(request);
}

TrialResults runTrial(const MotorFailureStudyOptions& options, simulation::SimulatedOptions simulated,
                      double speed, double occlusion, std::uint64_t seed, base::Progress& progress) {
  const double length = options.warm_up + options.duration;
  const TransferAtRate path(simulated.robot, speed, length, seed);
  simulated.trajectory.kind = simulation::TrajectoryKind::kRecorded;
  simulated.trajectory.recorded.file = path.file().string();
  simulated.joint_decimation = 10;
  simulation::SimulatedSource source(simulated);
  tracking::SourceInfo info = source.info();
  Run nominal{tracking::makePipeline(info, tracking::sixState()), live::MotorFailures({}), {}, {}};
  if (options.true_radii) info.robot = withTrueRadii(info.robot, simulated.truth);
  std::deque<Run> runs;
  runs.push_back({tracking::makePipeline(info, tracking::sixState()), live::MotorFailures({}), {}, {}});
  for (int which = 0; which < kCases; ++which)
    runs.push_back({tracking::makePipeline(info, tracking::sixState()),
                    live::MotorFailures(failuresOf(which, options)),
                    {},
                    {}});
  runs.push_back(std::move(nominal));
  live::OccludedSource occluded(source,
                                {.percentage = occlusion, .interval = kWindow, .start = options.warm_up});
  tracking::Sample sample;
  double t = 0.0;  // time of the newest motor sample [s]
  for (std::uint64_t count = 0; !progress.cancelled() && occluded.next(sample); ++count) {
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
    result.normal_rms = {runs.front().rmsFrom(options.warm_up), runs.back().rmsFrom(options.warm_up)};
    result.failed_rms = run.rmsFrom(options.warm_up);
    result.found = run.found;
    result.nees = run.paired == 0 ? kNan : run.nees / static_cast<double>(run.paired);
    for (std::size_t i = 0; i < kNormalErrors; ++i)
      result.within[i] = judge(run, options.warm_up, t, which, result.normal_rms[i]);
  }
  return results;
}

Vector3d rootMeanSquare(const std::vector<MotorFailureResult>& seeds, auto part) {
  Vector3d sum = Vector3d::Zero();
  for (const MotorFailureResult& one : seeds) sum += part(one).cwiseAbs2();
  return (sum / static_cast<double>(seeds.size())).cwiseSqrt();
}

Endurance over(const std::vector<MotorFailureResult>& seeds, std::size_t normal) {
  Endurance all;
  std::vector<double> held;
  for (const MotorFailureResult& one : seeds) {
    all.share += one.within[normal].share / static_cast<double>(seeds.size());
    all.whole += one.within[normal].whole;
    held.push_back(one.within[normal].held);
  }
  all.held = stats::median(held);
  return all;
}

MotorFailureResult over(const std::vector<MotorFailureResult>& seeds) {
  MotorFailureResult all = seeds.front();
  all.nees = 0.0;
  std::vector<double> found;
  for (const MotorFailureResult& one : seeds) {
    all.nees += one.nees / static_cast<double>(seeds.size());
    if (!std::isnan(one.found)) found.push_back(one.found);
  }
  for (std::size_t i = 0; i < kNormalErrors; ++i) {
    all.normal_rms[i] = rootMeanSquare(seeds, [i](const auto& one) { return one.normal_rms[i]; });
    all.within[i] = over(seeds, i);
  }
  all.failed_rms = rootMeanSquare(seeds, [](const auto& one) { return one.failed_rms; });
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

json fingerprintOf(const MotorFailureStudyOptions& options, const simulation::SimulatedOptions& robot,
                   double speed, double occlusion, std::uint64_t seed) {
  return {{"software", options.software},
          {"seed", seed},
          {"times", {options.warm_up, options.duration}},
          {"speed", speed},
          {"occlusion", occlusion},
          {"fault", base::nameOf(options.fault)},
          {"true radii", options.true_radii},
          {"images", options.images},
          {"nominal robot", robot::formatDescription(robot.robot)},
          {"truth", simulation::formatTruth(robot.truth)}};
}

json jsonOf(const TrialResults& results) {
  json all = json::array();
  for (const MotorFailureResult& one : results) {
    json document = {{"speed", one.speed},
                     {"occlusion", one.occlusion},
                     {"failed", vectorOrNull(one.failed_rms)},
                     {"found", numberOrNull(one.found)},
                     {"nees", numberOrNull(one.nees)}};
    for (std::size_t i = 0; i < kNormalErrors; ++i)
      document["normal"].push_back({{"rms", vectorOrNull(one.normal_rms[i])},
                                    {"held", one.within[i].held},
                                    {"share", numberOrNull(one.within[i].share)},
                                    {"whole", one.within[i].whole}});
    all.push_back(std::move(document));
  }
  return all;
}

MotorFailureResult resultOf(const json& trial, int which) {
  const json& document = trial.at(static_cast<std::size_t>(which));
  MotorFailureResult one;
  one.motor = which;
  document.at("speed").get_to(one.speed);
  document.at("occlusion").get_to(one.occlusion);
  one.failed_rms = vectorOrNan(document.at("failed"));
  one.found = numberOrNan(document.at("found"));
  one.nees = numberOrNan(document.at("nees"));
  for (std::size_t i = 0; i < kNormalErrors; ++i) {
    const json& normal = document.at("normal").at(i);
    one.normal_rms[i] = vectorOrNan(normal.at("rms"));
    one.within[i] = {.held = normal.at("held").get<double>(),
                     .share = numberOrNan(normal.at("share")),
                     .whole = normal.at("whole").get<int>()};
  }
  return one;
}

}  // namespace

double MotorFailureResult::ratio(NormalError which) const {
  double largest = 0.0;
  for (int joint = 0; joint < 3; ++joint)
    if (concerns(motor, joint)) largest = std::max(largest, failed_rms(joint) / normal(which)(joint));
  return largest;
}

MotorFailureStudy runMotorFailureStudy(const MotorFailureStudyOptions& options, base::Progress& progress) {
  const auto seeds = static_cast<std::uint64_t>(options.seeds);
  std::vector<KeptTrial> trials;
  for (const double speed : options.speeds)
    for (const double occlusion : options.occlusions)
      for (std::uint64_t seed = options.seed; seed < options.seed + seeds; ++seed) {
        const simulation::SimulatedOptions robot = robotOf(options, seed);
        trials.push_back(
            {fmt::format("{}{}, speed {:g}, {:g} % occluded, seed {}", base::nameOf(options.fault),
                         options.images ? ", pictures" : "", speed, occlusion, seed),
             [&options, robot, speed, occlusion, seed] {
               return fingerprintOf(options, robot, speed, occlusion, seed);
             },
             [&options, robot, speed, occlusion, seed](base::Progress& own) {
               return jsonOf(runTrial(options, robot, speed, occlusion, seed, own));
             }});
      }
  MotorFailureStudy study;
  KeptResults kept =
      runKept(trials, experiments::TrialStore(options.out), options.threads, progress, options.part);
  study.notices = std::move(kept.notices);
  study.cancelled = kept.cancelled;
  if (!kept.complete()) return study;
  for (int which = 0; which < kCases; ++which)
    for (std::size_t place = 0; place < trials.size() / seeds; ++place) {
      std::vector<MotorFailureResult> of;
      for (std::size_t s = 0; s < seeds; ++s) of.push_back(resultOf(kept.results[place * seeds + s], which));
      study.cells.push_back(over(of));
    }
  return study;
}

base::Table mapOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options,
                  NormalError normal) {
  base::Table table;
  const bool own = normal == NormalError::kOwn;
  table.title = fmt::format("Motor encoder {}: time within twice {}, failed by normal RMS, RMS",
                            base::nameOf(options.fault),
                            own ? "the normal error" : "the normal error with the nominal robot");
  table.columns = {{"motor", {}, 0}, {"speed", {}, 2}};
  for (const double occlusion : options.occlusions)
    table.columns.push_back({fmt::format("{:g} % occluded", occlusion), {}, 0});
  for (std::size_t i = 0; i < study.cells.size(); i += options.occlusions.size()) {
    std::vector<base::TableCell> row = {motorName(study.cells[i].motor), study.cells[i].speed};
    for (std::size_t k = 0; k < options.occlusions.size(); ++k) {
      const MotorFailureResult& cell = study.cells[i + k];
      const Endurance& endurance = cell.endurance(normal);
      row.push_back((endurance.whole == options.seeds ? std::string("whole trial")
                                                      : fmt::format("{:.1f} s", endurance.held)) +
                    fmt::format(", ×{:.1f}, {}", cell.ratio(normal), rmsText(cell)));
    }
    table.rows.push_back(std::move(row));
  }
  table.note = fmt::format(
      "Simulated robot ({} truth, {}), {} seed{} of {:g} s after the failure. The failed filter knows {} "
      "pulley "
      "radii; normal is {}. Error: RMS of a failed joint over the last 2 s, median over seeds. Speed: "
      "relative to "
      "a 200 s block transfer.",
      options.truth, options.images ? "rendered images" : "tip positions", options.seeds,
      options.seeds == 1 ? "" : "s", options.duration, options.true_radii ? "true" : "nominal",
      own ? "its own error with all encoders"
          : "the error of a filter with all encoders and nominal radii, as in the UKF paper");
  return table;
}

base::Table detailsOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options) {
  base::Table table;
  table.title = "Motor encoder failure, all numbers";
  table.columns = {
      {"motor", {}, 0}, {"speed", {}, 2}, {"occluded", "%", 0}, {"seeds", {}, 0}, {"found after", "s", 3}};
  const auto rmsColumns = [&](const std::string& of) {
    for (int joint = 0; joint < 3; ++joint)
      table.columns.push_back({fmt::format("{} q{}", of, joint + 1), joint == 2 ? "mm" : "deg", 4});
  };
  rmsColumns("failed");
  for (const auto& [normal, name] : base::NamesOf<NormalError>::value) {
    rmsColumns(fmt::format("normal ({})", name));
    table.columns.push_back({fmt::format("held ({})", name), "s", 2});
    table.columns.push_back({fmt::format("share within ({})", name), {}, 3});
    table.columns.push_back({fmt::format("whole trials ({})", name), {}, 0});
    table.columns.push_back({fmt::format("ratio ({})", name), {}, 2});
  }
  table.columns.push_back({"NEES / 3", {}, 3});
  for (const MotorFailureResult& cell : study.cells) {
    std::vector<base::TableCell> row = {motorName(cell.motor), cell.speed, cell.occlusion,
                                        static_cast<double>(options.seeds), cell.found};
    for (int joint = 0; joint < 3; ++joint)
      row.emplace_back(experiments::forPeople(cell.failed_rms(joint), joint));
    for (const auto& [normal, name] : base::NamesOf<NormalError>::value) {
      for (int joint = 0; joint < 3; ++joint)
        row.emplace_back(experiments::forPeople(cell.normal(normal)(joint), joint));
      const Endurance& endurance = cell.endurance(normal);
      row.insert(row.end(),
                 {endurance.held, endurance.share, static_cast<double>(endurance.whole), cell.ratio(normal)});
    }
    row.emplace_back(cell.nees);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace capstan::studies
