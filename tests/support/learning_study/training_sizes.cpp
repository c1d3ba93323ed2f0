#include "tests/support/learning_study/training_sizes.h"

#include <fmt/format.h>

#include <chrono>
#include <numbers>

#include "core/experiments/correction_errors.h"
#include "core/experiments/held_out.h"

namespace capstan::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using learning::State;

constexpr double kMillimetres = 1e3, kDegrees = 180.0 / std::numbers::pi;
constexpr Index kPaperFew = 460;
constexpr double kPaperSecondsFew = 18.6, kPaperSecondsAll = 4228.8;

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The exact process of one output beside the sparse one of the same model: RMS on held-out states.
void tellExact(const std::vector<State>& train, const std::vector<State>& test,
               const learning::CorrectionModel& model) {
  constexpr Index kOutput = 0;  // x
  const auto begin = std::chrono::steady_clock::now();
  const learning::SparseProcess& sparse = model.processes().front();
  const MatrixXd x = model.featuresOf(train), at = model.featuresOf(test);
  const MatrixXd y = model.targetsOf(train).col(kOutput), told = model.targetsOf(test).col(kOutput);
  const learning::ExactProcess exact(x, y, sparse.parameters());
  const double exact_rms = std::sqrt((exact.mean(at) - told).squaredNorm() / static_cast<double>(at.rows()));
  const double rms = std::sqrt((sparse.mean(at) - told).squaredNorm() / static_cast<double>(at.rows()));
  fmt::print(
      "Exact process of {} states, one output (x), same hyperparameters: {:.0f} s; held-out RMS {:.5f} of "
      "the "
      "scale, sparse {:.5f}: {:+.2f} %\n",
      train.size(), secondsSince(begin), exact_rms, rms, 100.0 * (rms / exact_rms - 1.0));
}

}  // namespace

void tellTrainingSizes(const LearningData& data, const LearningStudyOptions& options) {
  const std::vector<State>& states = data.robot.states;
  const auto [raw, test_raw] =
      experiments::splitStates(states, experiments::heldOut(states, 0.2, options.seed));
  const learning::CleaningReport cleaned = learning::cleanStates(raw);
  const std::vector<State> train = learning::kept(raw, cleaned);
  learning::CleaningReport judged;
  judged.reason = learning::judgedBy(cleaned, test_raw);
  const std::vector<State> test = learning::kept(test_raw, judged);
  fmt::print(
      "\nTraining size, towards the robot, {} clean states held out; the paper: {} states {} s, all {} s\n",
      test.size(), kPaperFew, kPaperSecondsFew, kPaperSecondsAll);
  for (const double share : {0.0, 0.05, 0.1, 0.25, 0.5, 1.0}) {
    const auto all = static_cast<Index>(train.size());
    const Index count = share == 0.0 ? kPaperFew : static_cast<Index>(share * static_cast<double>(all));
    std::vector<State> some;
    for (const Index k : learning::drawnPoints(all, count, options.seed))
      some.push_back(train[static_cast<std::size_t>(k)]);
    const auto begin = std::chrono::steady_clock::now();
    const auto model = learning::CorrectionModel::trained(some, options.correction);
    const double seconds = secondsSince(begin);
    experiments::PoseErrors error;
    const std::vector<Eigen::Isometry3d> corrected = model.correct(test);
    for (std::size_t k = 0; k < test.size(); ++k) error.add(corrected[k], test[k].pair.told);
    const experiments::CorrectionErrors sum = error.summed();
    fmt::print("  {:6} states {:8.2f} s {:8.3f} mm {:8.3f} deg\n", count, seconds,
               kMillimetres * sum.distance, kDegrees * sum.angle);
    std::fflush(stdout);
    if (share == 1.0) tellExact(train, test, model);
  }
}

}  // namespace capstan::study
