#include "core/studies/filter_study.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/checksum.h"
#include "core/base/yaml.h"
#include "core/experiments/trial_store.h"
#include "core/live/occluded_source.h"
#include "core/recording/table_source.h"
#include "core/simulation/simulation_request.h"
#include "core/studies/disturbances.h"
#include "core/studies/kept_trials.h"
#include "core/studies/true_radii.h"
#include "core/tracking/arrival.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::studies {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using tracking::FilterKind;

/// One filter, its errors, and its NIS once settled.
struct FilterCandidate {
  tracking::TrackingPipeline pipeline;
  tracking::TrackReport report;
  double nis_sum = 0.0;
  std::uint64_t accepted = 0, consistent = 0;

  void take(const tracking::Sample& sample, double settled) {
    const tracking::Snapshot& s = pipeline.step(sample);
    report.add(s);
    if (!s.camera_updated || s.gate != tracking::Gate::kOpen || s.t - report.first_t < settled) return;
    nis_sum += s.nis / 3.0;
    ++accepted;
    if (s.nis_consistent) ++consistent;
  }
  FilterResult result() const {
    const auto count = static_cast<double>(accepted);
    return {report.errors.ukf().value(),
            report.errors.ukfSeen().value(),
            nis_sum / count,
            static_cast<double>(consistent) / count,
            report.neesMean(),
            report.transmission};
  }
};

FilterCandidate candidateOf(const tracking::SourceInfo& info, const robot::Description& robot,
                            FilterKind filter) {
  tracking::SourceInfo believed = info;
  believed.robot = robot;
  tracking::TrackingOptions options = tracking::trackingOptionsOf(info);
  options.filter = filter;
  return {tracking::makePipeline(believed, options), {}};
}

/// A robot for a recording, and its name.
struct Believed {
  std::string name;
  robot::Description robot;
};

std::vector<FilterComparison> compare(tracking::Source& source, const std::vector<Believed>& robots,
                                      const Disturbance& disturbance, FilterComparison about, double settled,
                                      base::Progress& progress) {
  about.disturbance = disturbance.name;
  std::vector<FilterCandidate> candidates;
  for (const Believed& one : robots)
    for (const FilterKind filter : {FilterKind::kSixState, FilterKind::kAugmented}) {
      robot::Description file = one.robot;
      if (disturbance.robot) disturbance.robot(file);
      candidates.push_back(candidateOf(source.info(), file, filter));
    }
  live::OccludedSource occluded(source, {.percentage = about.occlusion});
  const double duration = source.info().duration;
  tracking::Sample sample;
  for (std::uint64_t count = 0; !progress.cancelled() && occluded.next(sample); ++count) {
    if (disturbance.samples) disturbance.samples(sample, duration);
    for (FilterCandidate& candidate : candidates) candidate.take(sample, settled);
    if (count % 256 == 0 && duration > 0.0)
      progress.report(std::min(1.0, tracking::arrivalOf(sample) / duration), about.recording);
  }
  std::vector<FilterComparison> all;
  for (std::size_t i = 0; i < robots.size() && !progress.cancelled(); ++i) {
    about.robot = robots[i].name;
    about.six_state = candidates[2 * i].result();
    about.augmented = candidates[2 * i + 1].result();
    about.kinematic = candidates[2 * i + 1].report.errors.kinematic().value();
    about.camera = candidates[2 * i + 1].report.errors.camera().value();
    all.push_back(about);
  }
  return all;
}

using Comparisons = std::vector<FilterComparison>;

/// One recording or simulation with one occlusion and one disturbance.
struct FilterTrial {
  std::size_t recording;  ///< index of the recording or of the simulation
  double occlusion;       ///< [%]
  const Disturbance* disturbance;
};

simulation::SimulationRequest requestOf(const FilterStudyOptions& options, const FilterTrial& trial) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.duration = options.duration;
  request.images = options.images && !options.disturbed;
  request.seed = options.seed + trial.recording;
  return request;
}

json fingerprintOf(const FilterStudyOptions& options, const FilterTrial& trial) {
  json fingerprint = {{"software", options.software},
                      {"occlusion", trial.occlusion},
                      {"disturbance", trial.disturbance->name},
                      {"settled", options.settled}};
  if (!options.recordings.empty()) {
    const robot::Description robot = robot::readDescriptionOrDefault(options.robot);
    fingerprint["recording"] = base::checksumOfFile(options.recordings[trial.recording]);
    fingerprint["nominal robot"] = robot::formatDescription(robot);
    return fingerprint;
  }
  const simulation::SimulationRequest request = requestOf(options, trial);
  const simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  fingerprint["seed"] = request.seed;
  fingerprint["images"] = request.images;
  fingerprint["nominal robot"] = robot::formatDescription(simulated.robot);
  fingerprint["truth"] = simulation::formatTruth(simulated.truth);
  fingerprint["trajectory"] = base::writeYaml(simulated.trajectory);
  return fingerprint;
}

Comparisons simulate(const FilterStudyOptions& options, const FilterTrial& trial, base::Progress& progress) {
  const simulation::SimulationRequest request = requestOf(options, trial);
  const simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  simulation::SimulatedSource source(simulated);
  const robot::Description& nominal = source.info().robot;
  FilterComparison about;
  about.recording = fmt::format("seed {}", request.seed);
  about.occlusion = trial.occlusion;
  return compare(source, {{"nominal", nominal}, {"true radii", withTrueRadii(nominal, simulated.truth)}},
                 *trial.disturbance, about, options.settled, progress);
}

Comparisons replay(const FilterStudyOptions& options, const FilterTrial& trial, base::Progress& progress) {
  const std::filesystem::path& file = options.recordings[trial.recording];
  const robot::Description robot = robot::readDescriptionOrDefault(options.robot);
  const auto source = recording::openRecording(file, robot);
  FilterComparison about;
  about.recording = file.filename().string();
  about.occlusion = trial.occlusion;
  return compare(*source, {{source->info().robot.name, source->info().robot}}, *trial.disturbance, about,
                 options.settled, progress);
}

std::string nameOf(const FilterStudyOptions& options, const FilterTrial& trial) {
  const std::string source = options.recordings.empty()
                                 ? fmt::format("seed {}", options.seed + trial.recording)
                                 : fmt::format("recording {} {}", trial.recording + 1,
                                               options.recordings[trial.recording].filename().string());
  return fmt::format("{}, {:g} % occluded, {}", source, trial.occlusion, trial.disturbance->name);
}

json jsonOf(const FilterResult& result) {
  return {{"ukf", vectorOrNull(result.ukf)},
          {"seen", vectorOrNull(result.seen)},
          {"nis", numberOrNull(result.nis)},
          {"consistent", numberOrNull(result.consistent)},
          {"nees", numberOrNull(result.nees)},
          {"scale", vectorOrNull(result.transmission.scale)},
          {"offset", vectorOrNull(result.transmission.offset)}};
}

FilterResult resultOf(const json& document) {
  FilterResult result;
  result.ukf = vectorOrNan(document.at("ukf"));
  result.seen = vectorOrNan(document.at("seen"));
  result.nis = numberOrNan(document.at("nis"));
  result.consistent = numberOrNan(document.at("consistent"));
  result.nees = numberOrNan(document.at("nees"));
  result.transmission.scale = vectorOrNan(document.at("scale"));
  result.transmission.offset = vectorOrNan(document.at("offset"));
  return result;
}

json jsonOf(const Comparisons& comparisons) {
  json all = json::array();
  for (const FilterComparison& one : comparisons)
    all.push_back({{"recording", one.recording},
                   {"robot", one.robot},
                   {"disturbance", one.disturbance},
                   {"occlusion", one.occlusion},
                   {"kinematic", vectorOrNull(one.kinematic)},
                   {"camera", vectorOrNull(one.camera)},
                   {"six_state", jsonOf(one.six_state)},
                   {"augmented", jsonOf(one.augmented)}});
  return all;
}

FilterComparison comparisonOf(const json& document) {
  FilterComparison one;
  document.at("recording").get_to(one.recording);
  document.at("robot").get_to(one.robot);
  document.at("disturbance").get_to(one.disturbance);
  document.at("occlusion").get_to(one.occlusion);
  one.kinematic = vectorOrNan(document.at("kinematic"));
  one.camera = vectorOrNan(document.at("camera"));
  one.six_state = resultOf(document.at("six_state"));
  one.augmented = resultOf(document.at("augmented"));
  return one;
}

/// Joints in deg, deg, mm.
double shown(const Vector3d& value, int joint) {
  return value(joint) * (joint == 2 ? 1e3 : 180.0 / std::numbers::pi);
}

}  // namespace

FilterStudy runFilterStudy(const FilterStudyOptions& options, base::Progress& progress) {
  const std::vector<Disturbance> all = disturbances();
  const std::size_t disturbed = options.disturbed ? all.size() : 1;
  const std::size_t recordings =
      options.recordings.empty() ? static_cast<std::size_t>(options.seeds) : options.recordings.size();
  std::vector<KeptTrial> trials;
  for (std::size_t i = 0; i < recordings * options.occlusions.size() * disturbed; ++i) {
    const FilterTrial trial{.recording = i / disturbed % recordings,
                            .occlusion = options.occlusions[i / disturbed / recordings],
                            .disturbance = &all[i % disturbed]};
    trials.push_back({nameOf(options, trial), [&options, trial] { return fingerprintOf(options, trial); },
                      [&options, trial](base::Progress& own) {
                        return jsonOf(options.recordings.empty() ? simulate(options, trial, own)
                                                                 : replay(options, trial, own));
                      }});
  }
  KeptResults kept =
      runKept(trials, experiments::TrialStore(options.out), options.threads, progress, options.part);
  FilterStudy study;
  study.notices = std::move(kept.notices);
  study.cancelled = kept.cancelled;
  for (const json& some : kept.results)
    for (const json& one : some) study.comparisons.push_back(comparisonOf(one));
  return study;
}

base::Table comparisonsOf(const FilterStudy& study) {
  base::Table table;
  table.title = "Six-state and augmented filter";
  table.columns = {
      {"recording", {}}, {"robot", {}}, {"disturbance", {}}, {"occlusion", "%", 0}, {"joint", {}}};
  for (const char* name : {"kinematic", "camera", "six-state", "augmented"})
    table.columns.push_back({name, "deg or mm", 4});
  table.columns.push_back({"augmented ≤ both inputs", {}});
  for (const char* name : {"NIS six-state", "NIS augmented", "in band"})
    table.columns.push_back({name, {}, 3});
  for (const FilterComparison& one : study.comparisons)
    for (int joint = 0; joint < 3; ++joint) {
      const bool holds = one.augmented.ukf(joint) <= one.kinematic(joint) &&
                         !(one.augmented.seen(joint) > one.camera(joint));  // NaN: no camera
      table.rows.push_back({one.recording, one.robot, one.disturbance, one.occlusion,
                            fmt::format("q{}", joint + 1), shown(one.kinematic, joint),
                            shown(one.camera, joint), shown(one.six_state.ukf, joint),
                            shown(one.augmented.ukf, joint), holds ? "yes" : "no", one.six_state.nis,
                            one.augmented.nis, one.augmented.consistent});
    }
  table.note =
      "RMS errors against the joint encoders: q1, q2 in degrees, q3 in millimetres. The camera's errors are "
      "those "
      "of accepted samples; the augmented filter is compared with it over the same time. NIS: mean NIS / 3 "
      "degrees of freedom of accepted camera samples, once settled. In band: share of these samples with the "
      "running mean of NIS in its 95 % band (augmented filter).";
  return table;
}

}  // namespace capstan::studies
