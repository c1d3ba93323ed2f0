#include "core/studies/cramer_rao_tables.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/experiments/tables.h"

namespace capstan::studies {
namespace {

constexpr std::array<const char*, 3> kJoints = {"q1 [deg]", "q2 [deg]", "q3 [mm]"};

}  // namespace

base::Table closenessOf(const CramerRaoStudy& study, const CramerRaoOptions& options) {
  base::Table table;
  table.title = fmt::format("Filter and posterior Cramér–Rao bound, {} runs of {:g} s, pixels ± {:g}{}",
                            study.runs, options.duration, options.pixel_sigma,
                            options.coulomb_friction ? "" : ", joints without Coulomb friction");
  table.columns = {{"joint", {}, 0},   {"R", {}, 0},     {"camera RMS", {}, 4}, {"√bound", {}, 5},
                   {"UKF RMS", {}, 5}, {"ratio", {}, 3}, {"95 %", {}, 0},       {"goal 1.10", {}, 0}};
  for (int joint = 0; joint < 3; ++joint)
    for (const auto& [noise, name] : base::NamesOf<StatedNoise>::value) {
      const auto i = static_cast<std::size_t>(noise);
      const auto& interval = study.interval[i][static_cast<std::size_t>(joint)];
      const double ratio = study.ratio[i](joint);
      table.rows.push_back({kJoints[static_cast<std::size_t>(joint)], std::string(name),
                            experiments::forPeople(study.camera(joint), joint),
                            experiments::forPeople(study.bound(joint), joint),
                            experiments::forPeople(study.rms[i](joint), joint), ratio,
                            fmt::format("{:.3f}–{:.3f}", interval.low, interval.high),
                            ratio <= kCramerRaoGoal ? "met" : "not met"});
    }
  table.note = fmt::format(
      "The filter's model is true; {} camera samples per run. NEES / 6: {:.3f} and {:.3f}, NIS / 3: {:.3f} "
      "and "
      "{:.3f}, with R of the pixels and constant.",
      study.updates, study.nees[0], study.nees[1], study.nis[0], study.nis[1]);
  return table;
}

base::Table noisesOf(const NoiseStudy& study, const NoiseStudyOptions& options) {
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
    for (int joint = 0; joint < 3; ++joint)
      row.emplace_back(experiments::forPeople(variant.ukf(joint), joint));
    for (int joint = 0; joint < 3; ++joint) row.emplace_back(ratio(joint));
    row.emplace_back(variant.nis);
    row.emplace_back(variant.nees);
    table.rows.push_back(row);
  }
  table.note =
      "Simulated robot; all rows see the same samples. True: the estimator knows the true pulley radii and "
      "has everything else nominal. Pixels: noise of the pixels, registration and clock; pixels alone: "
      "without the last two; no camera: R so large that the camera has no effect.";
  return table;
}

}  // namespace capstan::studies
