#include "core/studies/one_camera_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/base/yaml.h"
#include "core/experiments/trial_store.h"
#include "core/live/occluded_source.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/running_rms.h"
#include "core/studies/kept_trials.h"
#include "core/studies/true_radii.h"
#include "core/tracking/arrival.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::studies {
namespace {

using nlohmann::json;
using tracking::FilterKind;
using tracking::OneCamera;
using Comparisons = std::vector<OneCameraComparison>;

struct OneCameraCandidate {
  tracking::TrackingPipeline pipeline;
  tracking::TrackReport report;
  stats::RunningRms<3> blocked;
  std::uint64_t alone = 0;  // camera samples with the marker in one image

  void take(const tracking::Sample& sample, bool one_blocked) {
    const tracking::Snapshot& s = pipeline.step(sample);
    report.add(s);
    if (s.camera_updated)
      alone += s.gate == tracking::Gate::kLeftLost || s.gate == tracking::Gate::kRightLost;
    if (s.reference_paired && one_blocked) blocked.add(s.q_link_ukf - s.q_link_true);
  }
  OneCameraResult result() const {
    return {report.errors.ukf().value(), blocked.value(), report.nisMean(), report.rayNisMean(),
            static_cast<double>(report.rays) / static_cast<double>(std::max<std::uint64_t>(alone, 1))};
  }
};

OneCameraCandidate candidateOf(const tracking::SourceInfo& info, const robot::Description& robot,
                               FilterKind filter, OneCamera one_camera) {
  tracking::SourceInfo believed = info;
  believed.robot = robot;
  tracking::TrackingOptions options = tracking::trackingOptionsOf(info);
  options.filter = filter;
  options.one_camera = one_camera;
  return {tracking::makePipeline(believed, options), {}, {}};
}

simulation::SimulatedOptions simulationOf(const OneCameraStudyOptions& options) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.duration = options.duration;
  request.seed = options.seed;
  return simulation::optionsOf(request);
}

json fingerprintOf(const OneCameraStudyOptions& options, double share) {
  const simulation::SimulatedOptions simulated = simulationOf(options);
  return {{"software", options.software},
          {"seed", options.seed},
          {"share", share},
          {"blocked", static_cast<int>(options.blocked)},
          {"duration", options.duration},
          {"nominal robot", robot::formatDescription(simulated.robot)},
          {"truth", simulation::formatTruth(simulated.truth)},
          {"trajectory", base::writeYaml(simulated.trajectory)}};
}

json jsonOf(const OneCameraResult& result) {
  return {{"all", vectorOrNull(result.all)},
          {"blocked", vectorOrNull(result.blocked)},
          {"nis", numberOrNull(result.nis)},
          {"ray_nis", numberOrNull(result.ray_nis)},
          {"ray_share", numberOrNull(result.ray_share)}};
}

OneCameraResult resultOf(const json& document) {
  return {.all = vectorOrNan(document.at("all")),
          .blocked = vectorOrNan(document.at("blocked")),
          .nis = numberOrNan(document.at("nis")),
          .ray_nis = numberOrNan(document.at("ray_nis")),
          .ray_share = numberOrNan(document.at("ray_share"))};
}

json jsonOf(const Comparisons& comparisons) {
  json all = json::array();
  for (const OneCameraComparison& one : comparisons)
    all.push_back({{"share", one.share},
                   {"robot", one.robot},
                   {"filter", one.filter},
                   {"kinematic", vectorOrNull(one.kinematic)},
                   {"hard_switch", jsonOf(one.hard_switch)},
                   {"ray", jsonOf(one.ray)}});
  return all;
}

OneCameraComparison comparisonOf(const json& document) {
  return {.share = document.at("share").get<double>(),
          .robot = document.at("robot").get<std::string>(),
          .filter = document.at("filter").get<std::string>(),
          .kinematic = vectorOrNan(document.at("kinematic")),
          .hard_switch = resultOf(document.at("hard_switch")),
          .ray = resultOf(document.at("ray"))};
}

Comparisons compare(const OneCameraStudyOptions& options, double share, base::Progress& progress) {
  const simulation::SimulatedOptions simulated = simulationOf(options);
  simulation::SimulatedSource source(simulated);
  const tracking::SourceInfo& info = source.info();
  Comparisons all;
  std::vector<OneCameraCandidate> candidates;
  for (const bool true_radii : {false, true})
    for (const FilterKind filter : {FilterKind::kSixState, FilterKind::kAugmented}) {
      const auto robot = true_radii ? withTrueRadii(info.robot, simulated.truth) : info.robot;
      OneCameraComparison& one = all.emplace_back();
      one.share = share;
      one.robot = true_radii ? "true radii" : "nominal";
      one.filter = base::nameOf(filter);
      for (const OneCamera one_camera : {OneCamera::kKinematics, OneCamera::kRay})
        candidates.push_back(candidateOf(info, robot, filter, one_camera));
    }
  live::OccludedSource occluded(source, {.percentage = share, .cameras = options.blocked});
  tracking::Sample sample;
  for (std::uint64_t count = 0; !progress.cancelled() && occluded.next(sample); ++count) {
    for (OneCameraCandidate& candidate : candidates) candidate.take(sample, occluded.blocked());
    if (count % 256 == 0)
      progress.report(std::min(1.0, tracking::arrivalOf(sample) / options.duration), "tracking");
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].kinematic = candidates[2 * i].report.errors.kinematic().value();
    all[i].hard_switch = candidates[2 * i].result();
    all[i].ray = candidates[2 * i + 1].result();
  }
  return progress.cancelled() ? Comparisons{} : all;
}

double shown(const Eigen::Vector3d& value, int joint) {
  return base::degreesOrMillimetres(value(joint), joint != 2);
}

}  // namespace

OneCameraStudy runOneCameraStudy(const OneCameraStudyOptions& options, base::Progress& progress) {
  std::vector<KeptTrial> trials;
  for (std::size_t i = 0; i < options.shares.size(); ++i) {
    const double share = options.shares[i];
    trials.push_back(
        {fmt::format("{} {:g} % blocked", i + 1, share),
         [&options, share] { return fingerprintOf(options, share); },
         [&options, share](base::Progress& own) { return jsonOf(compare(options, share, own)); }});
  }
  KeptResults kept =
      runKept(trials, experiments::TrialStore(options.out), options.threads, progress, options.part);
  OneCameraStudy study;
  study.notices = std::move(kept.notices);
  study.cancelled = kept.cancelled;
  for (const json& some : kept.results)
    for (const json& one : some) study.comparisons.push_back(comparisonOf(one));
  return study;
}

base::Table comparisonsOf(const OneCameraStudy& study) {
  base::Table table;
  table.title = "One camera blocked: hard switch and ray of the other camera";
  table.columns = {{"blocked", "%", 0}, {"robot", {}}, {"filter", {}}, {"joint", {}}};
  for (const char* name : {"kinematic", "hard switch", "ray", "hard switch, blocked", "ray, blocked"})
    table.columns.push_back({name, "deg or mm", 4});
  for (const char* name : {"NIS hard switch", "NIS ray, pairs", "NIS ray, rays", "rays used"})
    table.columns.push_back({name, {}, 3});
  for (const OneCameraComparison& one : study.comparisons)
    for (int joint = 0; joint < 3; ++joint)
      table.rows.push_back({one.share, one.robot, one.filter, fmt::format("q{}", joint + 1),
                            shown(one.kinematic, joint), shown(one.hard_switch.all, joint),
                            shown(one.ray.all, joint), shown(one.hard_switch.blocked, joint),
                            shown(one.ray.blocked, joint), one.hard_switch.nis, one.ray.nis, one.ray.ray_nis,
                            one.ray.ray_share});
  table.note =
      "RMS errors against the joint encoders: q1, q2 in degrees, q3 in millimetres; blocked: only while the "
      "camera is "
      "blocked. NIS is divided by its degrees of freedom: 3 for a pair of images, 2 for a ray. Rays used: "
      "share of the "
      "images with the marker in one camera whose ray was accepted.";
  return table;
}

}  // namespace capstan::studies
