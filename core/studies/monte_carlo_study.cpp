#include "core/studies/monte_carlo_study.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/yaml.h"
#include "core/experiments/identify_trials.h"
#include "core/experiments/trial_setup.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/proportion.h"
#include "core/stats/quantile.h"
#include "core/studies/kept_trials.h"

namespace capstan::studies {
namespace {

using nlohmann::json;

std::size_t at(experiments::Method method) { return method == experiments::Method::kDualUkf ? 0 : 1; }

std::string nameOfSample(std::uint64_t seed) { return fmt::format("sample {}", seed); }

experiments::TrialSetup setUpSample(const MonteCarloOptions& options,
                                    const experiments::IdentificationSetup& identification,
                                    std::uint64_t seed) {
  experiments::TrialSetup setup;
  setup.spec.name = nameOfSample(seed);
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
  simulated.truth = drawRandomizedRobot(simulated.truth, radius, RandomizationSpread{}, seed);
  simulated.joint_decimation = 0;
  setup.inputs.truth = simulation::formatTruth(simulated.truth);
  setup.inputs.trajectory = base::writeYaml(simulated.trajectory);
  setup.belief = experiments::beliefOf({}, {});
  setup.fingerprint = {{"software", options.software},
                       {"seed", seed},
                       {"identification", identification.fingerprint},
                       {"nominal robot", robot::formatDescription(simulated.robot)},
                       {"truth", setup.inputs.truth},
                       {"trajectory", setup.inputs.trajectory}};
  setup.simulated = std::move(simulated);
  return setup;
}

json jsonOf(const experiments::IdentificationResult& result) {
  json parameters = json::array();
  for (const experiments::IdentifiedParameter& parameter : result.parameters) {
    json one = {{"truth", parameter.truth}};
    for (const experiments::ParameterEstimate* estimate : {&parameter.dual_ukf, &parameter.batch}) {
      one["value"].push_back(numberOrNull(estimate->value));
      one["low"].push_back(numberOrNull(estimate->low));
      one["high"].push_back(numberOrNull(estimate->high));
      one["seen"].push_back(estimate->seen);
    }
    parameters.push_back(std::move(one));
  }
  return {{"parameters", parameters}, {"seconds", {result.dual_seconds, result.batch_seconds}}};
}

RandomizedRobot sampleOf(const json& document, std::uint64_t seed) {
  RandomizedRobot sample;
  sample.seed = seed;
  document.at("seconds").get_to(sample.seconds);
  for (const json& parameter : document.at("parameters")) {
    MonteCarloEstimate& one = sample.parameters.emplace_back();
    parameter.at("truth").get_to(one.truth);
    parameter.at("seen").get_to(one.seen);
    for (std::size_t m = 0; m < 2; ++m) {
      one.value[m] = numberOrNan(parameter.at("value").at(m));
      one.low[m] = numberOrNan(parameter.at("low").at(m));
      one.high[m] = numberOrNan(parameter.at("high").at(m));
    }
  }
  return sample;
}

std::string percent(double value) { return fmt::format("{:.0f}", 100.0 * value); }

}  // namespace

double Recovery::coverage() const {
  return seen == 0 ? experiments::kNone : static_cast<double>(covered) / static_cast<double>(seen);
}

stats::Interval Recovery::coverageInterval() const {
  return stats::clopperPearsonInterval(static_cast<std::uint64_t>(covered), static_cast<std::uint64_t>(seen));
}

Recovery::Verdict Recovery::verdict() const {
  if (seen == 0) return Verdict::kUnseen;
  const stats::Interval interval = coverageInterval();
  if (interval.contains(kCoverageGoal)) return Verdict::kTooFew;
  return interval.low > kCoverageGoal ? Verdict::kMet : Verdict::kMissed;
}

Recovery MonteCarloStudy::recovery(std::size_t parameter, experiments::Method method) const {
  Recovery recovery;
  std::vector<double> errors, sigmas;
  const std::size_t m = at(method);
  for (const RandomizedRobot& sample : samples) {
    const MonteCarloEstimate& one = sample.parameters[parameter];
    const int covered = one.low[m] <= one.truth && one.truth <= one.high[m] ? 1 : 0;
    ++recovery.samples;
    recovery.covered_of_all += covered;
    if (!one.seen[m]) continue;
    ++recovery.seen;
    recovery.covered += covered;
    errors.push_back(std::abs(one.value[m] / one.truth - 1.0));
    sigmas.push_back(std::log(one.high[m] / one.low[m]) / (2.0 * stats::kNormal95));
  }
  recovery.median_error = stats::median(errors);
  recovery.median_sigma = stats::median(sigmas);
  return recovery;
}

MonteCarloStudy runMonteCarloStudy(const MonteCarloOptions& options, base::Progress& progress) {
  MonteCarloStudy study;
  experiments::Specification specification;
  specification.identification.parameters = options.parameters;
  const robot::Description nominal = simulation::optionsOf({}).robot;
  const experiments::IdentificationSetup setup = experiments::setUpIdentification(specification, nominal);
  const identification::ParameterSet set(nominal, options.parameters, setup.options.parameters);
  for (const auto& parameter : set.all()) study.names.push_back(parameter.name());

  std::vector<KeptTrial> trials;
  for (std::uint64_t seed = options.seed; trials.size() < static_cast<std::size_t>(options.samples); ++seed) {
    trials.push_back(
        {nameOfSample(seed),
         [&options, &setup, seed] { return setUpSample(options, setup, seed).fingerprint; },
         [&options, &setup, seed](base::Progress& own) {
           return jsonOf(experiments::identifyTrials({setUpSample(options, setup, seed)}, setup, 1, {own}));
         }});
  }
  const experiments::TrialStore store(options.out.empty() ? options.out : options.out / "samples");
  KeptResults kept = runKept(trials, store, options.threads, progress, options.part);
  study.notices = std::move(kept.notices);
  study.cancelled = kept.cancelled;
  for (std::size_t k = 0; k < kept.results.size(); ++k)
    if (!kept.results[k].is_null()) study.samples.push_back(sampleOf(kept.results[k], options.seed + k));
  return study;
}

base::Table recoveriesOf(const MonteCarloStudy& study, const MonteCarloOptions& options) {
  base::Table table;
  table.title = fmt::format("Known truth recovered for {} randomized robots, {:g} s of block transfer each",
                            study.samples.size(), options.duration);
  table.columns = {{"parameter", {}, 0},   {"method", {}, 0},        {"observable in", {}, 0},
                   {"inside 95 %", {}, 0}, {"coverage", {}, 0},      {"95 %", {}, 0},
                   {"goal 90 %", {}, 0},   {"median error", "%", 3}, {"median sigma", "%", 3}};
  for (std::size_t i = 0; i < study.names.size(); ++i)
    for (const experiments::Method method : {experiments::Method::kDualUkf, experiments::Method::kBatch}) {
      const Recovery r = study.recovery(i, method);
      std::vector<base::TableCell> row = {study.names[i],
                                          method == experiments::Method::kDualUkf ? "dual UKF" : "batch",
                                          fmt::format("{} of {}", r.seen, r.samples)};
      if (r.seen > 0) {
        const stats::Interval interval = r.coverageInterval();
        row.emplace_back(fmt::format("{} of {}", r.covered, r.seen));
        row.emplace_back(percent(r.coverage()) + " %");
        row.emplace_back(percent(interval.low) + "–" + percent(interval.high) + " %");
      } else {
        row.insert(row.end(), 3, base::TableCell("–"));
      }
      row.emplace_back(std::string(base::nameOf(r.verdict())));
      row.emplace_back(100.0 * r.median_error);
      row.emplace_back(100.0 * r.median_sigma);
      table.rows.push_back(std::move(row));
    }
  table.note =
      "Simulated robots. Seen: the recording at least halved the prior's sigma; the columns after it count "
      "these "
      "robots only, because the prior alone may cover the truth. 95 %: Clopper and Pearson's interval of the "
      "coverage; too few: it contains the goal. Sigma: median of the stated sigma.";
  return table;
}

}  // namespace capstan::studies
