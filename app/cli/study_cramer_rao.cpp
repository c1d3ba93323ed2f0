#include "app/cli/study_cramer_rao.h"

#include <memory>
#include <string>
#include <vector>

#include "app/cli/study_frame.h"
#include "core/base/names.h"
#include "core/studies/cramer_rao_tables.h"

namespace capstan::cli {
namespace {

using studies::CramerRaoOptions;
using studies::CramerRaoStudy;
using studies::NoiseStudy;
using studies::NoiseStudyOptions;
using studies::StatedNoise;

nlohmann::json documentOf(const CramerRaoStudy& study, const CramerRaoOptions& options) {
  nlohmann::json json = {{"runs", study.runs},
                         {"duration", options.duration},
                         {"seed", options.seed},
                         {"pixel_sigma", options.pixel_sigma},
                         {"goal", studies::kCramerRaoGoal},
                         {"bound", toJson(study.bound)},
                         {"camera_rms", toJson(study.camera)},
                         {"constant_sigma", toJson(study.constant_sigma)},
                         {"rescues", study.rescues}};
  for (const auto& [noise, name] : base::NamesOf<StatedNoise>::value) {
    const auto i = static_cast<std::size_t>(noise);
    nlohmann::json intervals = nlohmann::json::array();
    for (const auto& interval : study.interval[i]) intervals.push_back({interval.low, interval.high});
    json[std::string(name)] = {{"rms", toJson(study.rms[i])},
                               {"ratio", toJson(study.ratio[i])},
                               {"interval", intervals},
                               {"nees", study.nees[i]},
                               {"nis", study.nis[i]}};
  }
  return json;
}

nlohmann::json documentOf(const NoiseStudy& study) {
  nlohmann::json variants = nlohmann::json::array();
  for (std::size_t i = 0; i < study.variants.size(); ++i) {
    const auto& variant = study.variants[i];
    variants.push_back({{"noise", variant.name},
                        {"true_radius", variant.true_radius},
                        {"kinematic", toJson(variant.kinematic)},
                        {"camera", toJson(variant.camera)},
                        {"ukf", toJson(variant.ukf)},
                        {"ratio_to_constant", toJson(study.ratio(i, study.constantBeside(i)))},
                        {"nis", variant.nis},
                        {"nees", variant.nees}});
  }
  return {{"truth", study.truth}, {"variants", variants}};
}

/// Studies with the filter's own model, with and without friction, and with the default robot.
struct Studies {
  CramerRaoStudy bound, smooth;
  NoiseStudy noise;
  std::vector<std::string> notices;
  bool cancelled = false;
};

struct Options {
  CramerRaoOptions bound;
  NoiseStudyOptions noise;

  CramerRaoOptions smooth() const {
    CramerRaoOptions without = bound;
    without.coulomb_friction = false;
    return without;
  }
};

Studies studied(const Options& options, base::Progress& progress) {
  Studies studies;
  studies.noise = studies::studyNoise(options.noise, progress);
  if (!progress.cancelled()) studies.bound = studies::studyCramerRao(options.bound, progress);
  if (!progress.cancelled()) studies.smooth = studies::studyCramerRao(options.smooth(), progress);
  studies.cancelled = progress.cancelled();
  return studies;
}

StudyReport reportOf(const Studies& studies, const Options& options) {
  const base::Table matched = studies::closenessOf(studies.bound, options.bound),
                    smooth = studies::closenessOf(studies.smooth, options.smooth()),
                    noises = studies::noisesOf(studies.noise, options.noise);
  return {base::markdownOf(matched) + "\n" + base::markdownOf(smooth) + "\n" + base::markdownOf(noises),
          {{"matched", documentOf(studies.bound, options.bound)},
           {"matched_without_friction", documentOf(studies.smooth, options.smooth())},
           {"default", documentOf(studies.noise)}},
          {{"cramer-rao.csv", base::csvOf(matched)},
           {"cramer-rao-without-friction.csv", base::csvOf(smooth)},
           {"cramer-rao-noise.csv", base::csvOf(noises)}}};
}

ExitCode run(Options& options, const StudyArguments& arguments) {
  checkStudyOutputs(arguments, "cramer-rao", {}, {options.noise.truth});
  options.noise.seed = options.bound.seed;
  options.noise.threads = options.bound.threads;
  return runStudy(
      arguments, "cramer-rao",
      [&](base::Progress& progress, experiments::PartialRun*) { return studied(options, progress); },
      [](const Studies&) { return false; },
      [&](const Studies& studies) { return reportOf(studies, options); });
}

}  // namespace

void addCramerRaoStudy(CLI::App& study, ExitCode& exit) {
  auto options = std::make_shared<Options>();
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = study.add_subcommand(
      "cramer-rao",
      "Compare the filter's error to the posterior Cramér-Rao bound, and two choices of the "
      "measurement noise R: computed from the pixel noise, or constant");
  CramerRaoOptions& bound = options->bound;
  command->add_option("--runs", bound.runs, "number of random trajectories of the filter's model")
      ->capture_default_str()
      ->check(CLI::Range(2, 100000));
  command->add_option("--duration", bound.duration, "duration of each run [s]")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 300.0));
  command
      ->add_option("--pixel-sigma", bound.pixel_sigma,
                   "standard deviation of a marker's position in these runs [px]; rendered images have 0.025")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, 10.0));
  command
      ->add_option(
          "--truth", options->noise.truth,
          "true parameters of the simulated robot with which the two R are compared: default, or a truth\n"
          "file")
      ->capture_default_str();
  command
      ->add_option("--trials", options->noise.trials,
                   "number of simulated block transfers with which the two R are compared")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--trial-duration", options->noise.duration, "duration of each block transfer [s]")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 3600.0));
  command->add_flag_callback(
      "--no-images", [options] { options->noise.images = false; },
      "simulate tip positions instead of images");
  command->add_option("--seed", bound.seed, "random seed of runs and trials")->capture_default_str();
  arguments->keeps = false;
  addStudyOptions(*command, *arguments, bound.threads, "runs");
  refuseShardOption(*command, "is not for this study, which averages all runs at every time step");
  command->footer(
      "Examples:\n"
      "  capstan-cli study cramer-rao\n"
      "  capstan-cli study cramer-rao --runs 1000 --pixel-sigma 0.05 --json bound.json");
  command->callback([options, arguments, &exit] { exit = run(*options, *arguments); });
}

}  // namespace capstan::cli
