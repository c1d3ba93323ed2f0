#include "tests/support/learning_study/process_race.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>

#include "core/math/dense.h"

namespace capstan::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Seconds that `work` takes, the best of three.
template <class Work>
double bestOf(Work work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

/// `count` states: features and the first target.
MatrixXd drawn(const PlainTable& table, Index count, std::uint64_t seed) {
  const auto rows = learning::drawnPoints(table.features.rows(), count, seed);
  MatrixXd xy(static_cast<Index>(rows.size()), table.features.cols() + 1);
  xy << table.features(rows, Eigen::all), table.targets(rows, Eigen::seqN(0, 1));
  return xy;
}

void write(const std::filesystem::path& folder, const MatrixXd& xy, const learning::RbfParameters& start) {
  std::filesystem::create_directories(folder);
  writeNumbers(folder / "train.csv", xy);
  writeNumbers(folder / "start.csv", start.packed().transpose());
}

}  // namespace

void raceProcesses(const LearningData& data, const LearningStudyOptions& options) {
  const std::vector<learning::State>& states = data.robot.states;
  const std::vector<learning::State> clean = learning::kept(states, learning::cleanStates(states));
  const PlainTable table = plainScales(clean).of(clean);
  const std::filesystem::path folder = folderFor(options, "process");
  math::setDenseThreads(options.correction.threads);

  const MatrixXd many = drawn(table, 2000, 3), few = drawn(table, 460, 4), at = drawn(table, 200, 5);
  const Index d = table.features.cols();
  const MatrixXd x = many.leftCols(d), y = many.rightCols(1), x_few = few.leftCols(d),
                 y_few = few.rightCols(1);
  const auto start = learning::startOf(x, y, {}), start_few = learning::startOf(x_few, y_few, {});
  double value = 0.0;
  const double one = bestOf([&] {
    Eigen::VectorXd gradient;
    value = *learning::negativeLogLikelihood(x, y, start, &gradient);
  });
  learning::ProcessFitReport fit;
  const double trained =
      bestOf([&] { fit = learning::fitProcess(x_few, y_few, start_few, {.iterations = 200}); });
  const learning::ExactProcess process(x_few, y_few, fit.parameters);
  const learning::Prediction told = process.predict(at.leftCols(d));

  write(folder / "likelihood_2000", many, start);
  write(folder / "training_460", few, start_few);
  writeNumbers(folder / "training_460" / "at.csv", at.leftCols(d));
  writeNumbers(folder / "training_460" / "found.csv", fit.parameters.packed().transpose());
  const nlohmann::json theirs = askSklearn(folder);
  fmt::print("\nOne likelihood with gradient at 2,000 states, {} features: {:.3f} s", d, one);
  if (!theirs.is_null()) {
    const auto& likelihood = theirs["likelihood_2000"];
    fmt::print("; scikit-learn {:.3f} s: {:.1f} × (goal 6); values {:.6f} and {:.6f}",
               likelihood["seconds"].get<double>(), likelihood["seconds"].get<double>() / one, value,
               likelihood["value"].get<double>());
  }
  fmt::print("\nTraining at 460 states, one output: {:.3f} s, {} evaluations, −ln p = {:.4f}", trained,
             fit.evaluations, fit.negative_log_likelihood);
  if (!theirs.is_null()) {
    const auto& training = theirs["training_460"];
    double mean = 0.0, variance = 0.0;
    for (Index k = 0; k < at.rows(); ++k) {
      const auto row = static_cast<std::size_t>(k);
      mean = std::max(mean, std::abs(told.mean(k, 0) - training["mean"][row].get<double>()));
      variance = std::max(variance, std::abs(told.variance[k] - training["variance"][row].get<double>()));
    }
    fmt::print("; scikit-learn {:.3f} s: {:.1f} × (goal 10), −ln p = {:.4f}\n",
               training["seconds"].get<double>(), training["seconds"].get<double>() / trained,
               training["value"].get<double>());
    fmt::print("Predictions at equal hyperparameters differ by {:.1e} (mean) and {:.1e} (variance) at most",
               mean, variance);
  }
  fmt::print("\n");
}

}  // namespace capstan::study
