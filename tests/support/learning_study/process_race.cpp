#include "tests/support/learning_study/process_race.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/learning/gaussian_process/marginal_likelihood.h"
#include "core/math/dense.h"
#include "core/stats/quantile.h"
#include "tests/support/exact_process.h"

namespace capstan::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kFew = 460;

/// Seconds that `work` takes.
template <class Work>
double secondsOf(Work work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The best of three.
template <class Work>
double bestOf(Work work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) best = std::min(best, secondsOf(work));
  return best;
}

/// `count` states: features and the first target.
MatrixXd drawn(const PlainTable& table, Index count, std::uint64_t seed) {
  const auto rows = learning::drawnPoints(table.features.rows(), count, seed);
  MatrixXd xy(static_cast<Index>(rows.size()), table.features.cols() + 1);
  xy << table.features(rows, Eigen::all), table.targets(rows, Eigen::seqN(0, 1));
  return xy;
}

void write(const std::filesystem::path& folder, const MatrixXd& xy, const learning::KernelParameters& start) {
  std::filesystem::create_directories(folder);
  writeNumbers(folder / "train.csv", xy);
  writeNumbers(folder / "start.csv", start.packed().transpose());
}

/// One likelihood with its gradient, ours and theirs in turn.
void raceLikelihood(const MatrixXd& xy, const std::filesystem::path& folder) {
  constexpr int kTurns = 5;
  const MatrixXd x = xy.leftCols(xy.cols() - 1), y = xy.rightCols(1);
  const auto start = learning::startOf(x, y, {});
  write(folder / "likelihood", xy, start);
  learning::MarginalLikelihood likelihood(x, y);
  double value = 0.0, their_value = 0.0;
  std::vector<double> ours, theirs, ratios;
  for (int rotation = 0; rotation < kTurns; ++rotation) {
    ours.push_back(bestOf([&] {
      Eigen::VectorXd gradient;
      value = *likelihood.negativeLog(start, &gradient);
    }));
    const nlohmann::json answer = askSklearn(folder);
    if (answer.is_null()) continue;
    theirs.push_back(answer["likelihood"]["seconds"]);
    their_value = answer["likelihood"]["value"];
    ratios.push_back(theirs.back() / ours.back());
  }
  fmt::print("\nOne likelihood with gradient at {} states: {:.3f} s", xy.rows(), stats::median(ours));
  if (!ratios.empty())
    fmt::print(
        "; scikit-learn {:.3f} s: {:.1f} × (goal 6), of {} turns {:.1f} to {:.1f} ×; values {:.6f} and "
        "{:.6f}",
        stats::median(theirs), stats::median(ratios), kTurns, std::ranges::min(ratios),
        std::ranges::max(ratios), value, their_value);
  fmt::print("\n");
}

/// Hyperparameters learned, and what they predict.
struct Training {
  double seconds = 0.0;
  learning::ProcessFitReport fit;
  learning::Prediction commanded;
  nlohmann::json theirs;  ///< null: they did not answer
};

/// Ours, then theirs.
Training trainingOf(const MatrixXd& xy, const MatrixXd& at, const std::filesystem::path& folder) {
  const std::filesystem::path problem = folder / "training";
  const MatrixXd x = xy.leftCols(xy.cols() - 1), y = xy.rightCols(1);
  const auto start = learning::startOf(x, y, {});
  Training found;
  found.seconds = secondsOf([&] { found.fit = learning::fitProcess(x, y, start, {.iterations = 200}); });
  found.commanded = learning::ExactProcess(x, y, found.fit.parameters).predict(at);
  write(problem, xy, start);
  writeNumbers(problem / "at.csv", at);
  writeNumbers(problem / "found.csv", found.fit.parameters.packed().transpose());
  if (const nlohmann::json answer = askSklearn(folder); !answer.is_null()) found.theirs = answer["training"];
  return found;
}

/// Largest difference of means and of variances from scikit-learn's at our hyperparameters.
std::pair<double, double> differenceOf(const learning::Prediction& ours, const nlohmann::json& theirs) {
  double mean = 0.0, variance = 0.0;
  for (Index k = 0; k < ours.mean.rows(); ++k) {
    const auto row = static_cast<std::size_t>(k);
    mean = std::max(mean, std::abs(ours.mean(k, 0) - theirs["mean"][row].get<double>()));
    variance = std::max(variance, std::abs(ours.variance[k] - theirs["variance"][row].get<double>()));
  }
  return {mean, variance};
}

void tellTraining(const std::vector<Training>& trainings) {
  fmt::print(
      "\nTraining at {} states, one output, from the same start; a likelihood has several maxima, and "
      "which one a\nsearch ends in is chance\n",
      kFew);
  fmt::print(
      "  draw  ours [s]  evaluations      −ln p   scikit-learn [s]      −ln p   times  same to 1e-3\n");
  double mean = 0.0, variance = 0.0;
  std::vector<double> ratios, same;
  for (std::size_t k = 0; k < trainings.size(); ++k) {
    const Training& ours = trainings[k];
    fmt::print("  {:>4}  {:8.3f}  {:11}  {:9.4f}", k + 1, ours.seconds, ours.fit.evaluations,
               ours.fit.negative_log_likelihood);
    if (const nlohmann::json& other = ours.theirs; !other.is_null()) {
      const double seconds = other["seconds"], value = other["value"];
      const bool is_same = std::abs(value - ours.fit.negative_log_likelihood) < 1e-3;
      ratios.push_back(seconds / ours.seconds);
      if (is_same) same.push_back(ratios.back());
      fmt::print("   {:16.3f}  {:9.4f}  {:6.1f}  {}", seconds, value, ratios.back(),
                 is_same                                    ? "yes"
                 : value > ours.fit.negative_log_likelihood ? "no, ours is likelier"
                                                            : "no, theirs is likelier");
      const auto [of_mean, of_variance] = differenceOf(ours.commanded, other);
      mean = std::max(mean, of_mean), variance = std::max(variance, of_variance);
    }
    fmt::print("\n");
  }
  if (ratios.empty()) return;
  fmt::print("  median {:.1f} × of all", stats::median(ratios));
  if (!same.empty())
    fmt::print(", {:.1f} × of the {} with the same maximum (goal 10)", stats::median(same), same.size());
  fmt::print("\n");
  fmt::print("  predictions at equal hyperparameters differ by {:.1e} (mean) and {:.1e} (variance) at most\n",
             mean, variance);
}

}  // namespace

void raceProcesses(const LearningData& data, const LearningStudyOptions& options) {
  constexpr int kDraws = 10;
  const std::vector<learning::State>& states = data.robot.states;
  const std::vector<learning::State> clean = learning::kept(states, learning::cleanStates(states));
  const PlainTable table = plainScales(clean).of(clean);
  const std::filesystem::path folder = folderFor(options, "process");
  math::setDenseThreads(options.correction.threads);

  raceLikelihood(drawn(table, 2000, 3), folder / "likelihood");
  const MatrixXd at = drawn(table, 200, 5).leftCols(table.features.cols());
  std::vector<Training> trainings;
  for (int k = 0; k < kDraws; ++k)
    trainings.push_back(trainingOf(drawn(table, kFew, 100 + static_cast<std::uint64_t>(k)), at,
                                   folder / fmt::format("{:02}", k + 1)));
  tellTraining(trainings);
}

}  // namespace capstan::study
