#include "app/cli/study_monte_carlo.h"

#include <memory>
#include <string>

#include "app/cli/study_frame.h"
#include "core/base/resource.h"
#include "core/studies/monte_carlo_study.h"

namespace capstan::cli {
namespace {

using experiments::Method;
using studies::MonteCarloOptions;
using studies::MonteCarloStudy;
using studies::Recovery;

/// Coverage and errors by parameter and method. `coverage` counts the samples that determine the parameter,
/// `coverage_of_all` counts all samples.
nlohmann::json recoveries(const MonteCarloStudy& study) {
  nlohmann::json all;
  for (std::size_t i = 0; i < study.names.size(); ++i)
    for (const Method method : {Method::kDualUkf, Method::kBatch}) {
      const Recovery r = study.recovery(i, method);
      nlohmann::json& one = all[study.names[i]][method == Method::kDualUkf ? "dual_ukf" : "batch"];
      one = {{"samples", r.samples},
             {"seen", r.seen},
             {"covered", r.covered},
             {"coverage", r.coverage()},
             {"coverage_interval", nullptr},
             {"covered_of_all", r.covered_of_all},
             {"coverage_of_all", static_cast<double>(r.covered_of_all) / r.samples},
             {"goal", base::keyOf(r.verdict())},
             {"median_error", r.median_error},
             {"median_sigma", r.median_sigma}};
      if (r.seen > 0) one["coverage_interval"] = {r.coverageInterval().low, r.coverageInterval().high};
    }
  return all;
}

nlohmann::json documentOf(const MonteCarloStudy& study, const MonteCarloOptions& options) {
  nlohmann::json samples = nlohmann::json::array();
  for (const auto& sample : study.samples) {
    nlohmann::json one = {{"seed", sample.seed}, {"seconds", sample.seconds}};
    for (std::size_t i = 0; i < study.names.size(); ++i) {
      const auto& estimate = sample.parameters[i];
      one["parameters"][study.names[i]] = {{"truth", estimate.truth},
                                           {"value", estimate.value},
                                           {"low", estimate.low},
                                           {"high", estimate.high},
                                           {"seen", estimate.seen}};
    }
    samples.push_back(one);
  }
  return {{"methods", {"dual_ukf", "batch"}},
          {"duration", options.duration},
          {"pixel_sigma", options.pixel_sigma},
          {"software", options.software},
          {"coverage_goal", studies::kCoverageGoal},
          {"recovery", recoveries(study)},
          {"samples", samples}};
}

StudyReport reportOf(const MonteCarloStudy& study, const MonteCarloOptions& options) {
  const base::Table table = studies::recoveriesOf(study, options);
  return {base::markdownOf(table), documentOf(study, options), {{"monte-carlo.csv", base::csvOf(table)}}};
}

ExitCode run(MonteCarloOptions& options, const StudyArguments& arguments) {
  if (options.truth.empty()) options.truth = base::resource("truth/laboratory.yaml");
  options.trajectory = base::resource("experiments/fls.yaml");
  checkStudyOutputs(arguments, "monte-carlo", {}, {options.truth});
  options.out = arguments.out;
  return runStudy(
      arguments, "monte-carlo",
      [&](base::Progress& progress, experiments::PartialRun* part) {
        options.part = part;
        return studies::runMonteCarloStudy(options, progress);
      },
      [](const MonteCarloStudy& study) { return !study.samples.empty(); },
      [&](const MonteCarloStudy& study) { return reportOf(study, options); });
}

CLI::App* addNamed(CLI::App& study, const char* name, ExitCode& exit) {
  auto options = std::make_shared<MonteCarloOptions>();
  auto arguments = std::make_shared<StudyArguments>();
  options->software = base::software();
  CLI::App* command =
      study.add_subcommand(name, "Coverage and error of identified parameters over randomized robots");
  command->add_option("--count", options->samples, "number of randomized robots")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  command->add_option("--duration", options->duration, "duration of each recording [s]")
      ->capture_default_str()
      ->check(CLI::Range(20.0, 3600.0));
  command->add_option("--seed", options->seed, "random seed of the first robot; it increases by 1 per robot")
      ->capture_default_str();
  command->add_option("--parameters", options->parameters, "parameters to identify, as in `identify`")
      ->capture_default_str();
  command
      ->add_option("--truth", options->truth,
                   "truth file whose parameters are the centre of the distribution of random robots; by "
                   "default truth/laboratory.yaml of the program's resources")
      ->check(CLI::ExistingFile);
  command->add_option("--pixel-sigma", options->pixel_sigma, "standard deviation of a marker's position [px]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 10.0));
  addStudyOptions(*command, *arguments, options->threads, "randomized robots");
  command->footer(
      "One random robot takes about half a minute on one core. Examples:\n"
      "  capstan-cli study monte-carlo --out samples    # continues where it was stopped\n"
      "  capstan-cli study monte-carlo --count 10 --duration 60");
  command->callback([options, arguments, &exit] { exit = run(*options, *arguments); });
  return command;
}

}  // namespace

void addMonteCarloStudy(CLI::App& study, ExitCode& exit) {
  addNamed(study, "monte-carlo", exit);
  addNamed(study, "worlds", exit)->group("");  // its name in version 0.1: not listed, still understood
}

}  // namespace capstan::cli
