#include "core/studies/health_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/base/yaml.h"
#include "core/experiments/trial_store.h"
#include "core/live/motor_failures.h"
#include "core/simulation/simulation_request.h"
#include "core/studies/kept_trials.h"
#include "core/studies/true_radii.h"
#include "core/tracking/arrival.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::studies {
namespace {

using nlohmann::json;
using tracking::HealthVerdict;
using tracking::Sample;
using tracking::StereoFrame;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// What is wrong in a session.
struct Fault {
  std::string name;
  std::vector<std::string> expected;
  bool true_radii = true;
  double cameras_rotated = 0.0;  ///< about the vertical axis of frame 0, through its origin [rad]
  std::function<void(StereoFrame&)> frames = nullptr;
  bool encoder_frozen = false;  ///< that of motor 2, from half of the session on
};

void shiftStamp(StereoFrame& frame, double by) {
  frame.t += by;
  frame.t_arrival = std::max(frame.t_arrival, frame.t);
}

/// Blackens both images for 3 of every 5 s.
void hideMarker(StereoFrame& frame) {
  if (std::fmod(frame.t, 5.0) >= 3.0) return;
  frame.left = cv::Mat::zeros(frame.left.size(), frame.left.type());
  frame.right = cv::Mat::zeros(frame.right.size(), frame.right.type());
}

std::vector<Fault> faults() {
  std::vector<Fault> all;
  all.push_back({"none", {}});
  all.push_back({"nominal pulley radii", {"transmission"}, false});
  all.push_back({"cameras rotated by 3°", {"transmission", "refused"}, true, base::toRadians(3.0)});
  all.push_back({"stamps 50 ms late", {"transmission"}, true, 0.0, [](StereoFrame& frame) {
                   shiftStamp(frame, 0.05);
                 }});
  all.push_back(
      {"images 300 ms old", {"latency"}, true, 0.0, [](StereoFrame& frame) { shiftStamp(frame, -0.3); }});
  all.push_back({"marker hidden 60 %", {"detection_left", "detection_right"}, true, 0.0, hideMarker});
  all.push_back({"encoder 2 frozen", {"encoders"}, true, 0.0, nullptr, true});
  return all;
}

struct HealthCandidate {
  Fault fault;
  tracking::TrackingPipeline pipeline;
  robot::Description robot;
  double memory;
  live::MotorFailures failures;
  tracking::TrackReport report;

  void take(Sample sample) {
    if (auto* frame = std::get_if<StereoFrame>(&sample); frame && fault.frames) fault.frames(*frame);
    if (auto* motor = std::get_if<tracking::MotorSample>(&sample)) failures.apply(*motor);
    report.add(pipeline.step(sample));
  }
};

HealthCandidate candidateOf(const tracking::SourceInfo& info, const simulation::Truth& truth, double duration,
                            Fault fault) {
  tracking::SourceInfo assumed = info;
  if (fault.true_radii) assumed.robot = withTrueRadii(info.robot, truth);
  if (assumed.base_from_camera)
    assumed.base_from_camera =
        Eigen::AngleAxisd(fault.cameras_rotated, Eigen::Vector3d::UnitZ()) * *assumed.base_from_camera;
  const tracking::TrackingOptions options = tracking::trackingOptionsOf(assumed);
  std::vector<live::MotorFailure> failures;
  if (fault.encoder_frozen) failures.push_back({1, 0.5 * duration, tracking::MotorFault::kFrozen});
  return {std::move(fault),
          tracking::makePipeline(assumed, options),
          assumed.robot,
          options.memory,
          live::MotorFailures(failures),
          {}};
}

/// What one session of one fault adds to its case.
struct Outcome {
  std::vector<tracking::HealthCheck> checks;
  Eigen::Vector3d nis, rms;
};

json jsonOf(const std::vector<Outcome>& outcomes) {
  json all = json::array();
  for (const Outcome& outcome : outcomes) {
    json checks = json::array();
    for (const tracking::HealthCheck& check : outcome.checks)
      checks.push_back({check.key, static_cast<int>(check.verdict)});
    all.push_back(
        {{"checks", checks}, {"nis", vectorOrNull(outcome.nis)}, {"rms", vectorOrNull(outcome.rms)}});
  }
  return all;
}

/// Outcomes with key and verdict of each check only.
std::vector<Outcome> outcomesOf(const json& document) {
  std::vector<Outcome> outcomes;
  for (const json& one : document) {
    Outcome& outcome = outcomes.emplace_back();
    for (const json& check : one.at("checks"))
      outcome.checks.push_back({.key = check.at(0).get<std::string>(),
                                .verdict = static_cast<HealthVerdict>(check.at(1).get<int>())});
    outcome.nis = vectorOrNan(one.at("nis"));
    outcome.rms = vectorOrNan(one.at("rms"));
  }
  return outcomes;
}

simulation::SimulatedOptions simulationOf(const HealthStudyOptions& options, std::uint64_t seed) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.duration = options.duration;
  request.seed = seed;
  return simulation::optionsOf(request);
}

json fingerprintOf(const HealthStudyOptions& options, std::uint64_t seed) {
  const simulation::SimulatedOptions simulated = simulationOf(options, seed);
  return {{"software", options.software},
          {"seed", seed},
          {"duration", options.duration},
          {"nominal robot", robot::formatDescription(simulated.robot)},
          {"truth", simulation::formatTruth(simulated.truth)},
          {"trajectory", base::writeYaml(simulated.trajectory)}};
}

std::vector<Outcome> session(const HealthStudyOptions& options, std::uint64_t seed,
                             base::Progress& progress) {
  const simulation::SimulatedOptions simulated = simulationOf(options, seed);
  simulation::SimulatedSource source(simulated);
  std::vector<HealthCandidate> candidates;
  for (Fault& fault : faults())
    candidates.push_back(candidateOf(source.info(), simulated.truth, options.duration, std::move(fault)));
  Sample sample;
  for (std::uint64_t count = 0; !progress.cancelled() && source.next(sample); ++count) {
    for (HealthCandidate& candidate : candidates) candidate.take(sample);
    if (count % 256 == 0)
      progress.report(std::min(1.0, tracking::arrivalOf(sample) / options.duration), "tracking");
  }
  std::vector<Outcome> outcomes;
  for (const HealthCandidate& candidate : candidates)
    outcomes.push_back({tracking::healthOf(candidate.report, candidate.robot, candidate.memory),
                        candidate.report.innovations.nis(), candidate.report.errors.ukf().value()});
  return outcomes;
}

void add(const Outcome& outcome, HealthStudyCase& to) {
  ++to.verdicts[static_cast<std::size_t>(tracking::worstOf(outcome.checks))];
  bool named = false, other = false;
  for (const tracking::HealthCheck& check : outcome.checks) {
    if (check.verdict <= HealthVerdict::kPass) continue;
    const bool expected = std::find(to.expected.begin(), to.expected.end(), check.key) != to.expected.end();
    (expected ? named : other) = true;
    if (!expected && std::find(to.others.begin(), to.others.end(), check.key) == to.others.end())
      to.others.push_back(check.key);
  }
  to.named += named;
  to.other += other;
  to.nis_low = to.nis_low.cwiseMin(outcome.nis);
  to.nis_high = to.nis_high.cwiseMax(outcome.nis);
  to.rms += outcome.rms.cwiseAbs2();
}

}  // namespace

HealthStudy runHealthStudy(const HealthStudyOptions& options, base::Progress& progress) {
  std::vector<KeptTrial> trials;
  const auto sessions = static_cast<std::uint64_t>(options.sessions);
  for (std::uint64_t seed = options.seed; seed < options.seed + sessions; ++seed)
    trials.push_back({fmt::format("session {}", seed),
                      [&options, seed] { return fingerprintOf(options, seed); },
                      [&options, seed](base::Progress& own) { return jsonOf(session(options, seed, own)); }});
  KeptResults kept =
      runKept(trials, experiments::TrialStore(options.out), options.threads, progress, options.part);
  HealthStudy study;
  study.notices = std::move(kept.notices);
  study.cancelled = kept.cancelled;
  if (!kept.complete()) return study;
  std::vector<std::vector<Outcome>> done;
  for (const json& result : kept.results) done.push_back(outcomesOf(result));
  const std::vector<Fault> all = faults();
  for (std::size_t i = 0; i < all.size(); ++i) {
    HealthStudyCase one;
    one.fault = all[i].name;
    one.expected = all[i].expected;
    one.nis_low.setConstant(kInf);
    one.nis_high.setConstant(-kInf);
    for (const std::vector<Outcome>& outcomes : done) add(outcomes[i], one);
    one.rms = (one.rms / options.sessions).cwiseSqrt();
    study.cases.push_back(one);
  }
  return study;
}

base::Table casesOf(const HealthStudy& study) {
  base::Table table;
  table.title = "Verdicts on sessions with one known fault";
  table.columns = {{"fault", {}},      {"pass", {}, 0},  {"cautious", {}, 0},  {"FAIL", {}, 0},
                   {"named", {}, 0},   {"other", {}, 0}, {"other checks", {}}, {"NIS q1", {}},
                   {"NIS q2", {}},     {"NIS q3", {}},   {"UKF q1", "deg", 3}, {"UKF q2", "deg", 3},
                   {"UKF q3", "mm", 3}};
  for (const HealthStudyCase& one : study.cases) {
    const auto verdicts = [&](HealthVerdict verdict) {
      return static_cast<double>(one.verdicts[static_cast<std::size_t>(verdict)]);
    };
    std::vector<base::TableCell> row{one.fault,
                                     verdicts(HealthVerdict::kPass),
                                     verdicts(HealthVerdict::kCautious),
                                     verdicts(HealthVerdict::kFail),
                                     static_cast<double>(one.named),
                                     static_cast<double>(one.other),
                                     fmt::format("{}", fmt::join(one.others, ", "))};
    for (int joint = 0; joint < 3; ++joint)
      row.emplace_back(fmt::format("{:.2f} to {:.2f}", one.nis_low(joint), one.nis_high(joint)));
    for (int joint = 0; joint < 3; ++joint)
      row.emplace_back(base::degreesOrMillimetres(one.rms(joint), joint != 2));
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Named: sessions in which a check that belongs to the fault does not pass; other: in which another "
      "check "
      "does not pass. NIS: smallest and largest mean of a session.";
  return table;
}

}  // namespace capstan::studies
