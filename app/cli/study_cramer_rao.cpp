#include "app/cli/study_cramer_rao.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/base/names.h"
#include "core/base/table.h"
#include "core/base/units.h"
#include "core/experiments/cramer_rao_study.h"
#include "core/experiments/noise_study.h"

namespace capstan::cli {
namespace {

using experiments::CramerRaoOptions;
using experiments::CramerRaoStudy;
using experiments::NoiseStudy;
using experiments::NoiseStudyOptions;
using experiments::NoiseTold;

constexpr double kGoal = 1.10;
constexpr std::array<const char*, 3> kJoints = {"q1 [deg]", "q2 [deg]", "q3 [mm]"};

double shown(const Eigen::Vector3d& value, int joint) {
  return joint < 2 ? base::toDegrees(value(joint)) : base::toMillimetres(value(joint));
}

base::Table tableOf(const CramerRaoStudy& study, const CramerRaoOptions& options) {
  base::Table table;
  table.title = fmt::format("Filter and posterior Cramér–Rao bound, {} runs of {:g} s, pixels ± {:g}{}",
                            study.runs, options.duration, options.pixel_sigma,
                            options.coulomb_friction ? "" : ", joints without Coulomb friction");
  table.columns = {{"joint", {}, 0},   {"R", {}, 0},     {"camera RMS", {}, 4}, {"√bound", {}, 5},
                   {"UKF RMS", {}, 5}, {"ratio", {}, 3}, {"95 %", {}, 0},       {"goal 1.10", {}, 0}};
  for (int joint = 0; joint < 3; ++joint)
    for (const auto& [told, name] : base::NamesOf<NoiseTold>::value) {
      const auto i = static_cast<std::size_t>(told);
      const auto& interval = study.interval[i][static_cast<std::size_t>(joint)];
      const double ratio = study.ratio[i](joint);
      table.rows.push_back({kJoints[static_cast<std::size_t>(joint)], std::string(name),
                            shown(study.camera, joint), shown(study.bound, joint), shown(study.rms[i], joint),
                            ratio, fmt::format("{:.3f}–{:.3f}", interval.low, interval.high),
                            ratio <= kGoal ? "met" : "not met"});
    }
  table.note = fmt::format(
      "The filter's model is true; {} camera samples a run. NEES / 6: {:.3f} and {:.3f}, NIS / 3: {:.3f} and "
      "{:.3f}, with R of the pixels and constant.",
      study.updates, study.nees[0], study.nees[1], study.nis[0], study.nis[1]);
  return table;
}

base::Table tableOf(const NoiseStudy& study, const NoiseStudyOptions& options) {
  base::Table table;
  table.title = fmt::format("Tracking the {} robot, RMS errors, {} × {:g} s of block transfer", study.truth,
                            options.trials, options.duration);
  table.columns = {{"pulley radii", {}, 0}, {"R", {}, 0}};
  for (const char* joint : kJoints) table.columns.push_back({joint, {}, 4});
  for (const char* joint : {"q1 / constant", "q2 / constant", "q3 / constant"})
    table.columns.push_back({joint, {}, 3});
  table.columns.push_back({"NIS / 3", {}, 3});
  table.columns.push_back({"NEES / 3", {}, 3});
  for (std::size_t i = 0; i < study.variants.size(); ++i) {
    const auto& variant = study.variants[i];
    const Eigen::Vector3d ratio = study.ratio(i, study.constantBeside(i));
    std::vector<base::TableCell> row = {variant.true_radius ? "true" : "nominal", variant.name};
    for (int joint = 0; joint < 3; ++joint) row.emplace_back(shown(variant.ukf, joint));
    for (int joint = 0; joint < 3; ++joint) row.emplace_back(ratio(joint));
    row.emplace_back(variant.nis);
    row.emplace_back(variant.nees);
    table.rows.push_back(row);
  }
  table.note =
      "Simulated robot; all rows see the same samples. True: the estimator knows the true pulley radii and "
      "has everything else nominal. Pixels: noise of the pixels, registration and clock; pixels alone: "
      "without the last two; no camera: R so large that the camera says nothing.";
  return table;
}

nlohmann::json jsonOf(const CramerRaoStudy& study, const CramerRaoOptions& options) {
  nlohmann::json json = {{"runs", study.runs},
                         {"duration", options.duration},
                         {"seed", options.seed},
                         {"pixel_sigma", options.pixel_sigma},
                         {"goal", kGoal},
                         {"bound", toJson(study.bound)},
                         {"camera_rms", toJson(study.camera)},
                         {"constant_sigma", toJson(study.constant_sigma)},
                         {"rescues", study.rescues}};
  for (const auto& [told, name] : base::NamesOf<NoiseTold>::value) {
    const auto i = static_cast<std::size_t>(told);
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

nlohmann::json jsonOf(const NoiseStudy& study) {
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

struct Arguments {
  CramerRaoOptions bound;
  NoiseStudyOptions noise;
  std::string json;
};

ExitCode run(Arguments& arguments) {
  checkOutputs({{"--json", arguments.json}}, {arguments.noise.truth});
  arguments.noise.seed = arguments.bound.seed;
  arguments.noise.threads = arguments.bound.threads;
  const Output output(arguments.json);
  base::Progress progress;
  CramerRaoStudy bound, smooth;
  CramerRaoOptions without = arguments.bound;
  without.coulomb_friction = false;
  NoiseStudy noise;
  {
    const ProgressLine line(progress);
    noise = experiments::studyNoise(arguments.noise, progress);
    if (!noise.cancelled) bound = experiments::studyCramerRao(arguments.bound, progress);
    if (!bound.cancelled) smooth = experiments::studyCramerRao(without, progress);
  }
  if (noise.cancelled || bound.cancelled || smooth.cancelled) {
    notice("cancelled");
    return kFailed;
  }
  output.text(base::markdownOf(tableOf(bound, arguments.bound)) + "\n" +
              base::markdownOf(tableOf(smooth, without)) + "\n" +
              base::markdownOf(tableOf(noise, arguments.noise)));
  output.json({{"matched", jsonOf(bound, arguments.bound)},
               {"matched_without_friction", jsonOf(smooth, without)},
               {"default", jsonOf(noise)}});
  return kOk;
}

}  // namespace

void addCramerRaoStudy(CLI::App& study, ExitCode& exit) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = study.add_subcommand(
      "cramer-rao",
      "The filter against the posterior Cramér-Rao bound, and R from pixels against a constant");
  CramerRaoOptions& bound = arguments->bound;
  command->add_option("--runs", bound.runs, "truths drawn from the filter's model")
      ->capture_default_str()
      ->check(CLI::Range(2, 100000));
  command->add_option("--duration", bound.duration, "of each run [s]")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 300.0));
  command->add_option("--pixel-sigma", bound.pixel_sigma, "noise of a marker's position in these runs [px]")
      ->capture_default_str()
      ->check(CLI::Range(1e-3, 10.0));
  command->add_option("--truth", arguments->noise.truth, "of the robot tracked beside: default or a file")
      ->capture_default_str();
  command->add_option("--trials", arguments->noise.trials, "block transfers of that robot")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  command->add_option("--trial-duration", arguments->noise.duration, "of each [s]")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 3600.0));
  command->add_flag_callback(
      "--no-images", [arguments] { arguments->noise.images = false; }, "tip positions instead of pictures");
  command->add_option("--seed", bound.seed, "of runs and trials")->capture_default_str();
  command->add_option("--threads", bound.threads, "runs at the same time")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli study cramer-rao\n"
      "  capstan-cli study cramer-rao --runs 1000 --pixel-sigma 0.05 --json bound.json");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
