#include "core/studies/filter_study.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "core/base/workers.h"
#include "core/live/occluded_source.h"
#include "core/recording/table_source.h"
#include "core/simulation/simulation_request.h"
#include "core/studies/disturbances.h"
#include "core/studies/true_radii.h"
#include "core/tracking/arrival.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::studies {
namespace {

using Eigen::Vector3d;
using tracking::FilterKind;

/// One filter, its errors, and its NIS once settled.
struct Candidate {
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

Candidate candidateOf(const tracking::SourceInfo& info, const robot::Description& robot, FilterKind filter) {
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
  std::vector<Candidate> candidates;
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
    for (Candidate& candidate : candidates) candidate.take(sample, settled);
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

Comparisons simulate(const FilterStudyOptions& options, int trial, double occlusion,
                     const Disturbance& disturbance, base::Progress& progress) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.duration = options.duration;
  request.images = options.images && !options.disturbed;
  request.seed = options.seed + static_cast<std::uint64_t>(trial);
  const simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  simulation::SimulatedSource source(simulated);
  const robot::Description& nominal = source.info().robot;
  FilterComparison about;
  about.recording = fmt::format("seed {}", request.seed);
  about.occlusion = occlusion;
  return compare(source, {{"nominal", nominal}, {"true radii", withTrueRadii(nominal, simulated.truth)}},
                 disturbance, about, options.settled, progress);
}

Comparisons replay(const FilterStudyOptions& options, const std::filesystem::path& file, double occlusion,
                   const Disturbance& disturbance, base::Progress& progress) {
  const robot::Description robot = robot::readDescriptionOrDefault(options.robot);
  const auto source = recording::openRecording(file, robot);
  FilterComparison about;
  about.recording = file.filename().string();
  about.occlusion = occlusion;
  return compare(*source, {{source->info().robot.name, source->info().robot}}, disturbance, about,
                 options.settled, progress);
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
  std::vector<Comparisons> done(recordings * options.occlusions.size() * disturbed);
  std::vector<base::Job> jobs;
  for (std::size_t i = 0; i < done.size(); ++i) {
    const std::size_t r = i / disturbed % recordings;
    const double occlusion = options.occlusions[i / disturbed / recordings];
    jobs.push_back(
        {fmt::format("{} of {}", i + 1, done.size()), 1.0,
         [&into = done[i], &options, &disturbance = all[i % disturbed], occlusion, r](base::Progress& part) {
           into = options.recordings.empty()
                      ? simulate(options, static_cast<int>(r), occlusion, disturbance, part)
                      : replay(options, options.recordings[r], occlusion, disturbance, part);
         }});
  }
  base::doAll(jobs, options.threads, {progress});
  FilterStudy study;
  study.cancelled = progress.cancelled();
  for (const Comparisons& some : done)
    study.comparisons.insert(study.comparisons.end(), some.begin(), some.end());
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
