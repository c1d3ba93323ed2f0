#include "core/experiments/world_study.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/yaml.h"
#include "core/experiments/identify_trials.h"
#include "core/experiments/trial_setup.h"
#include "core/experiments/trial_store.h"
#include "core/experiments/workers.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/quantile.h"

namespace capstan::experiments {
namespace {

using nlohmann::json;

std::size_t at(Method method) { return method == Method::kDualUkf ? 0 : 1; }

TrialSetup setUpWorld(const WorldStudyOptions& options, std::uint64_t seed) {
  TrialSetup setup;
  setup.spec.name = fmt::format("world {}", seed);
  setup.spec.duration = options.duration;
  setup.spec.seed = seed;
  simulation::SimulationRequest request;
  request.trajectory = options.trajectory;
  request.duration = options.duration;
  request.truth = options.truth;
  request.seed = seed;
  request.images = false;
  simulation::SimulatedOptions simulated = simulation::optionsOf(request);
  Eigen::Vector3d radius;
  for (int i = 0; i < 3; ++i) radius(i) = simulated.robot.drives[static_cast<std::size_t>(i)].link_radius;
  simulated.truth.cameras.pixel_sigma = options.pixel_sigma;
  simulated.truth = drawWorld(simulated.truth, radius, options.spread, seed);
  simulated.joint_decimation = 0;
  setup.inputs.truth = simulation::formatTruth(simulated.truth);
  setup.inputs.trajectory = base::writeYaml(simulated.trajectory);
  setup.belief = beliefOf({}, {});
  setup.fingerprint = {{"software", options.software},
                       {"seed", seed},
                       {"parameters", options.parameters},
                       {"truth", setup.inputs.truth},
                       {"trajectory", setup.inputs.trajectory}};
  setup.simulated = std::move(simulated);
  return setup;
}

World worldOf(const IdentificationResult& result, std::uint64_t seed) {
  World world;
  world.seed = seed;
  world.seconds = {result.dual_seconds, result.batch_seconds};
  for (const IdentifiedParameter& parameter : result.parameters) {
    WorldEstimate& one = world.parameters.emplace_back();
    one.truth = parameter.truth;
    for (std::size_t m = 0; m < 2; ++m) {
      const ParameterEstimate& estimate = m == 0 ? parameter.dual_ukf : parameter.batch;
      one.value[m] = estimate.value;
      one.low[m] = estimate.low;
      one.high[m] = estimate.high;
      one.seen[m] = estimate.seen;
    }
  }
  return world;
}

json jsonOf(const World& world) {
  json parameters = json::array();
  for (const WorldEstimate& one : world.parameters)
    parameters.push_back({{"truth", one.truth},
                          {"value", one.value},
                          {"low", one.low},
                          {"high", one.high},
                          {"seen", one.seen}});
  return {{"parameters", parameters}, {"seconds", world.seconds}};
}

World worldOf(const json& document, std::uint64_t seed) {
  World world;
  world.seed = seed;
  document.at("seconds").get_to(world.seconds);
  for (const json& parameter : document.at("parameters")) {
    WorldEstimate& one = world.parameters.emplace_back();
    parameter.at("truth").get_to(one.truth);
    parameter.at("value").get_to(one.value);
    parameter.at("low").get_to(one.low);
    parameter.at("high").get_to(one.high);
    parameter.at("seen").get_to(one.seen);
  }
  return world;
}

}  // namespace

Recovery WorldStudy::recovery(std::size_t parameter, Method method) const {
  Recovery recovery;
  std::vector<double> errors, widths;
  const std::size_t m = at(method);
  for (const World& world : worlds) {
    const WorldEstimate& one = world.parameters[parameter];
    ++recovery.worlds;
    recovery.covered += one.low[m] <= one.truth && one.truth <= one.high[m] ? 1 : 0;
    if (!one.seen[m]) continue;
    ++recovery.seen;
    errors.push_back(std::abs(one.value[m] / one.truth - 1.0));
    widths.push_back(0.5 * (one.high[m] - one.low[m]) / one.value[m]);
  }
  recovery.median_error = stats::median(errors);
  recovery.median_half_width = stats::median(widths);
  return recovery;
}

WorldStudy runWorldStudy(const WorldStudyOptions& options, base::Progress& progress) {
  WorldStudy study;
  Specification specification;
  specification.identification.parameters = options.parameters;
  const robot::Description nominal = simulation::optionsOf({}).robot;
  const IdentificationSetup setup = setUpIdentification(specification, nominal);
  const identification::ParameterSet set(nominal, options.parameters);
  for (const auto& parameter : set.all()) study.names.push_back(parameter.name());

  const TrialStore store(options.out.empty() ? options.out : options.out / "worlds");
  const auto count = static_cast<std::size_t>(options.worlds);
  std::vector<std::optional<World>> worlds(count);
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t seed = options.seed + k;
    const TrialSetup trial = setUpWorld(options, seed);
    std::string notice;
    const auto kept = store.find(trial.spec.name, trial.fingerprint, notice);
    if (!notice.empty()) study.notices.push_back(notice);
    if (kept) {
      worlds[k] = worldOf(*kept, seed);
      continue;
    }
    jobs.push_back({trial.spec.name, 1.0, [trial, seed, k, &worlds, &store, &setup](base::Progress& own) {
                      const IdentificationResult result = identifyTrials({trial}, setup, 1, {own});
                      if (own.cancelled()) return;
                      worlds[k] = worldOf(result, seed);
                      store.keep(trial.spec.name, trial.fingerprint, jsonOf(*worlds[k]));
                    }});
  }
  doAll(jobs, options.threads, {progress});
  study.cancelled = progress.cancelled();
  for (std::optional<World>& world : worlds)
    if (world) study.worlds.push_back(std::move(*world));
  return study;
}

}  // namespace capstan::experiments
