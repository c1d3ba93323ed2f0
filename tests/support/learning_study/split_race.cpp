#include "tests/support/learning_study/split_race.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/learning/evaluation/correction_study.h"
#include "core/learning/evaluation/held_out.h"
#include "core/math/dense.h"

namespace capstan::study {
namespace {

using Eigen::Index;
using learning::State;

constexpr Index kPlainStates = 1500, kPlainFitted = 1000;

/// States, hyperparameters and test states of one split for scikit-learn.
void writeSplit(const std::filesystem::path& folder, const std::vector<State>& states,
                const std::vector<bool>& held, const LearningStudyOptions& options) {
  const auto [train, test] = learning::splitStates(states, held);
  const learning::CleaningReport cleaned = learning::cleanStates(train);
  const std::vector<State> clean = learning::kept(train, cleaned);
  const std::vector<learning::Reason> reasons = learning::judgedBy(cleaned, test);
  const PlainScales scales = plainScales(clean);
  const PlainTable all = scales.of(clean), asked = scales.of(test);
  const auto few = learning::drawnPoints(all.features.rows(), kPlainStates, options.seed);
  const Eigen::MatrixXd x = all.features(few, Eigen::all), y = all.targets(few, Eigen::all);
  Eigen::MatrixXd parameters(6, 2 + x.cols());
  math::setDenseThreads(1);
  const auto fewer = learning::drawnPoints(x.rows(), kPlainFitted, options.seed + 7);
  const Eigen::MatrixXd x_fewer = x(fewer, Eigen::all);
  base::parallelFor(6, options.correction.threads, [&](std::size_t k) {
    const Eigen::MatrixXd own = y(fewer, Eigen::seqN(static_cast<Index>(k), 1));
    const auto fit = learning::fitProcess(x_fewer, own, learning::startOf(x_fewer, own, {}));
    parameters.row(static_cast<Index>(k)) = fit.parameters.packed().transpose();
  });
  Eigen::MatrixXd xy(x.rows(), x.cols() + 6), tested(asked.features.rows(), x.cols() + 7);
  xy << x, y;
  Eigen::VectorXd is_clean(static_cast<Index>(reasons.size()));
  for (std::size_t k = 0; k < reasons.size(); ++k)
    is_clean[static_cast<Index>(k)] = reasons[k] == learning::Reason::kNone;
  tested << asked.features, asked.targets, is_clean;
  std::filesystem::create_directories(folder);
  writeNumbers(folder / "train.csv", xy);
  writeNumbers(folder / "test.csv", tested);
  writeNumbers(folder / "scale.csv", all.scale);
  writeNumbers(folder / "parameters.csv", parameters);
}

struct Means {
  double distance = 0.0, angle = 0.0;
};

Means sklearnMeans(const nlohmann::json& answer, const char* kind) {
  Means means;
  for (const auto& [name, split] : answer.items()) {
    means.distance += split[kind][0].get<double>() / static_cast<double>(answer.size());
    means.angle += split[kind][1].get<double>() / static_cast<double>(answer.size());
  }
  return means;
}

void tellCalibration(const learning::CorrectionStudyReport& report) {
  fmt::print("Within the stated σ, held out, last method: x, y, z, turns\n");
  for (const double sigmas : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
    fmt::print("  {:.1f} σ:", sigmas);
    for (std::size_t i = 0; i < 6; ++i) fmt::print(" {:5.1f} %", 100.0 * report.stated.within(i, sigmas));
    fmt::print("  normal {:5.1f} %\n", 100.0 * learning::normalShare(sigmas));
  }
}

void tellBeside(const learning::CorrectionStudyReport& report, const nlohmann::json& plain) {
  if (plain.is_null()) return;
  const auto& ours_dirty = report.dirty.back();
  const auto& ours_clean = report.clean.back();
  for (const auto& [name, ours] : {std::pair{"dirty", &ours_dirty}, std::pair{"clean", &ours_clean}}) {
    const Means theirs = sklearnMeans(plain, name);
    fmt::print("  {:6} ours {:.2f} mm {:.2f} deg; scikit-learn {:.2f} mm {:.2f} deg: {:+.1f} %, {:+.1f} %\n",
               name, base::toMillimetres(ours->distance), base::toDegrees(ours->angle),
               base::toMillimetres(theirs.distance), base::toDegrees(theirs.angle),
               100.0 * (ours->distance / theirs.distance - 1.0), 100.0 * (ours->angle / theirs.angle - 1.0));
  }
}

}  // namespace

void raceSplits(const LearningData& data, const LearningStudyOptions& options) {
  for (const Target* target : {&data.robot, &data.command}) {
    const std::string name(base::nameOf(target->towards));
    if (std::ranges::count(options.towards, name) == 0) continue;
    const auto begin = std::chrono::steady_clock::now();
    learning::CorrectionStudyOptions study;
    study.splits = options.splits;
    study.seed = options.seed;
    study.correction = options.correction;
    const auto report = learning::correctionStudy(target->states, study);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    fmt::print("\nTable I towards the {}, {} splits by trajectory, lag of {:.1f} ms taken off ({:.0f} s)\n",
               name, options.splits, 1e3 * target->clock_offset.clock_offset, took.count());
    fmt::print("{}\n{}\n",
               base::markdownOf(learning::correctionTable(report.dirty, learning::paperDirty(),
                                                          "Dirty, towards the " + name)),
               base::markdownOf(learning::correctionTable(report.clean, learning::paperClean(),
                                                          "Clean, towards the " + name)));
    tellCalibration(report);
    fmt::print(
        "Of the mean square of these errors, clean, {:.0f} % (distance) and {:.0f} % (angle) change from one "
        "observation to the\nnext, as noise does that no correction knows\n",
        100.0 * report.jitter.distance, 100.0 * report.jitter.angle);
    const std::filesystem::path folder = folderFor(options, "table_" + name);
    for (int split = 0; split < options.splits; ++split)
      writeSplit(folder / fmt::format("split_{:02}", split), target->as_told,
                 learning::heldOut(target->states, study.test_share,
                                   options.seed + static_cast<std::uint64_t>(split)),
                 options);
    fmt::print(
        "Means of ‖Δt‖ and of the geodesic angle, beside a plain scikit-learn process on the same splits,\n"
        "learned from 1,500 of the states that cleaning kept\n");
    tellBeside(report, askSklearn(folder));
    std::fflush(stdout);
  }
}

}  // namespace capstan::study
