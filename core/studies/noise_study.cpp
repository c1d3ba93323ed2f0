#include "core/studies/noise_study.h"

#include <cmath>

#include "core/base/workers.h"
#include "core/simulation/simulation_request.h"
#include "core/studies/true_radii.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::studies {
namespace {

using Eigen::Vector3d;

std::vector<NoiseVariant> allVariants() {
  const tracking::TrackingOptions sources = tracking::sixState();
  tracking::TrackingOptions constant = sources, pixels = sources, nothing = sources;
  constant.camera_noise = tracking::CameraNoiseKind::kConstant;
  pixels.registration_rotation_sigma = pixels.registration_shift_sigma = pixels.camera_clock_sigma = 0.0;
  nothing.camera_noise = tracking::CameraNoiseKind::kConstant;
  nothing.constant_camera_sigma.setConstant(10.0);
  std::vector<NoiseVariant> all;
  const std::vector<std::pair<std::string, tracking::TrackingOptions>> kinds = {
      {"pixels", sources}, {"constant", constant}, {"pixels alone", pixels}, {"no camera", nothing}};
  for (const bool true_radius : {true, false})
    for (const auto& [name, options] : kinds)
      all.push_back({.name = name, .options = options, .true_radius = true_radius});
  return all;
}

using Reports = std::vector<tracking::TrackReport>;

/// Runs one trial through the pipelines of all variants.
Reports runTrial(const NoiseStudyOptions& options, int trial, const std::vector<NoiseVariant>& variants,
                 base::Progress& progress) {
  simulation::SimulationRequest request;
  request.truth = options.truth;
  request.duration = options.duration;
  request.seed = options.seed + static_cast<std::uint64_t>(trial);
  request.images = options.images;
  const simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  simulation::SimulatedSource source(simulated);
  std::vector<tracking::TrackingPipeline> pipelines;
  for (const NoiseVariant& variant : variants) {
    tracking::SourceInfo info = source.info();
    if (variant.true_radius) info.robot = withTrueRadii(info.robot, simulated.truth);
    pipelines.push_back(tracking::makePipeline(info, variant.options));
  }
  Reports reports(variants.size());
  tracking::Sample sample;
  for (std::uint64_t count = 0; source.next(sample) && !progress.cancelled(); ++count) {
    for (std::size_t i = 0; i < pipelines.size(); ++i) reports[i].add(pipelines[i].step(sample));
    if (count % 256 == 0) progress.report(pipelines[0].snapshot().t / options.duration, "tracking");
  }
  return reports;
}

/// Root mean square over trials of (nearly) equal length.
template <class Part>
Vector3d pooled(const std::vector<Reports>& trials, std::size_t variant, Part part) {
  Vector3d squares = Vector3d::Zero();
  for (const Reports& reports : trials) squares += part(reports[variant].errors).value().cwiseAbs2();
  return (squares / static_cast<double>(trials.size())).cwiseSqrt();
}

}  // namespace

NoiseStudy studyNoise(const NoiseStudyOptions& options, base::Progress& progress) {
  NoiseStudy study;
  study.truth = options.truth;
  study.variants = allVariants();
  std::vector<Reports> trials(static_cast<std::size_t>(options.trials));
  std::vector<base::Job> jobs;
  for (int trial = 0; trial < options.trials; ++trial)
    jobs.push_back({"trial " + std::to_string(trial + 1), 1.0, [&, trial](base::Progress& own) {
                      trials[static_cast<std::size_t>(trial)] = runTrial(options, trial, study.variants, own);
                    }});
  base::doAll(jobs, options.threads, {progress});
  study.cancelled = progress.cancelled();
  if (study.cancelled) return study;
  for (std::size_t i = 0; i < study.variants.size(); ++i) {
    NoiseVariant& variant = study.variants[i];
    variant.kinematic = pooled(trials, i, [](const auto& errors) { return errors.kinematic(); });
    variant.camera = pooled(trials, i, [](const auto& errors) { return errors.camera(); });
    variant.ukf = pooled(trials, i, [](const auto& errors) { return errors.ukf(); });
    for (const Reports& reports : trials) {
      variant.nis += reports[i].nisMean() / static_cast<double>(trials.size());
      variant.nees += reports[i].neesMean() / static_cast<double>(trials.size());
    }
  }
  return study;
}

}  // namespace capstan::studies
