#include "tests/support/learning_study/training_sizes.h"

#include <fmt/format.h>

#include <chrono>

#include "core/base/units.h"
#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/evaluation/held_out.h"
#include "tests/support/exact_process.h"

namespace capstan::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using learning::State;

constexpr Index kPaperFew = 460;
constexpr double kPaperSecondsFew = 18.6, kPaperSecondsAll = 4228.8;

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Means of ‖Δt‖ and of the rotation's error [mm, deg], from outputs in scales.
std::pair<double, double> meansOf(const MatrixXd& off, const Eigen::RowVectorXd& scale) {
  const MatrixXd apart = off * scale.asDiagonal();
  return {base::toMillimetres(apart.leftCols(3).rowwise().norm().mean()),
          base::toDegrees(apart.rightCols(3).rowwise().norm().mean())};
}

/// The exact process of all outputs, of the first members' hyperparameters, beside the model's: held out.
void tellExact(const std::vector<State>& train, const std::vector<State>& test,
               const learning::CorrectionModel& model) {
  const auto begin = std::chrono::steady_clock::now();
  const MatrixXd x = model.featuresOf(train), at = model.featuresOf(test);
  const MatrixXd y = model.targetsOf(train), commanded = model.targetsOf(test);
  MatrixXd exact(commanded.rows(), commanded.cols()), ours = exact;
  Index first = 0;
  for (const learning::Committee& committee : model.processes()) {
    const Index count = committee.outputs();
    const learning::ExactProcess process(x, y.middleCols(first, count),
                                         committee.members().front().parameters());
    exact.middleCols(first, count) = process.mean(at);
    ours.middleCols(first, count) = committee.mean(at);
    first += count;
  }
  fmt::print("  Exact process of all {} states, the first members' hyperparameters, six outputs: {:.0f} s\n",
             train.size(), secondsSince(begin));
  const Eigen::RowVectorXd scale = model.parts().scale;
  const auto [ours_mm, ours_deg] = meansOf(ours - commanded, scale);
  const auto [exact_mm, exact_deg] = meansOf(exact - commanded, scale);
  fmt::print(
      "    mean held-out error: exact {:.4f} mm {:.4f} deg, ours {:.4f} mm {:.4f} deg: {:+.2f} %, {:+.2f} "
      "%\n",
      exact_mm, exact_deg, ours_mm, ours_deg, 100.0 * (ours_mm / exact_mm - 1.0),
      100.0 * (ours_deg / exact_deg - 1.0));
  fmt::print("    RMS of x, y, z and the rotation's three, ours to exact:");
  for (Index k = 0; k < commanded.cols(); ++k)
    fmt::print(" {:+.2f} %",
               100.0 * ((ours - commanded).col(k).norm() / (exact - commanded).col(k).norm() - 1.0));
  fmt::print("\n");
}

/// Errors on `test` and seconds, from 460 states to all.
void tellSizes(const std::vector<State>& train, const std::vector<State>& test,
               const learning::CorrectionOptions& options, std::uint64_t seed) {
  for (const double share : {0.0, 0.05, 0.1, 0.25, 0.5, 1.0}) {
    const auto all = static_cast<Index>(train.size());
    const Index count = share == 0.0 ? kPaperFew : static_cast<Index>(share * static_cast<double>(all));
    std::vector<State> some;
    for (const Index k : learning::drawnPoints(all, count, seed))
      some.push_back(train[static_cast<std::size_t>(k)]);
    const auto begin = std::chrono::steady_clock::now();
    const auto model = learning::CorrectionModel::trained(some, options);
    const double seconds = secondsSince(begin);
    learning::PoseErrors error;
    const std::vector<Eigen::Isometry3d> corrected = model.correct(test);
    for (std::size_t k = 0; k < test.size(); ++k) error.add(corrected[k], test[k].pair.commanded);
    const learning::CorrectionErrors sum = error.summed();
    fmt::print("  {:6} states {:8.2f} s {:8.3f} mm {:8.3f} deg\n", count, seconds,
               base::toMillimetres(sum.distance), base::toDegrees(sum.angle));
    std::fflush(stdout);
    if (share == 1.0) tellExact(train, test, model);
  }
}

}  // namespace

void tellTrainingSizes(const LearningData& data, const LearningStudyOptions& options) {
  const std::vector<State>& states = data.robot.states;
  const auto [raw, test_raw] = learning::splitStates(states, learning::heldOut(states, 0.2, options.seed));
  const learning::CleaningReport cleaned = learning::cleanStates(raw);
  const std::vector<State> train = learning::kept(raw, cleaned);
  learning::CleaningReport judged;
  judged.reason = learning::judgedBy(cleaned, test_raw);
  const std::vector<State> test = learning::kept(test_raw, judged);
  for (const learning::Motion motion : {learning::Motion::kVelocity, learning::Motion::kHistory}) {
    fmt::print(
        "\nTraining size, from poses and {}, towards the robot, {} clean states held out; the paper: {} "
        "states\n{} s, all {} s\n",
        motion == learning::Motion::kVelocity ? "velocities" : "history", test.size(), kPaperFew,
        kPaperSecondsFew, kPaperSecondsAll);
    learning::CorrectionOptions own = options.correction;
    own.motion = motion;
    tellSizes(train, test, own, options.seed);
  }
}

}  // namespace capstan::study
