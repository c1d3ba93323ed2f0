// Sparse processes that are averaged.
#include "core/learning/gaussian_process/committee.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/learning/gaussian_process/process_fit.h"

namespace capstan::learning {
namespace {

struct Sample {
  Eigen::MatrixXd x, y;
};

/// A function of four features that the first two bend most.
Sample sample(Eigen::Index n, std::uint64_t seed, double noise = 0.1) {
  base::Random random(seed, "committee test");
  Sample s{Eigen::MatrixXd(n, 4), Eigen::MatrixXd(n, 2)};
  for (Eigen::Index r = 0; r < n; ++r) {
    for (Eigen::Index c = 0; c < 4; ++c) s.x(r, c) = random.uniform(-2.0, 2.0);
    s.y(r, 0) = std::sin(2.0 * s.x(r, 0)) + 0.2 * s.x(r, 2) + random.normal(0.0, noise);
    s.y(r, 1) = s.x(r, 0) * std::cos(2.0 * s.x(r, 1)) + 0.1 * s.x(r, 3) + random.normal(0.0, noise);
  }
  return s;
}

SparseProcess knowingNothing(const Sample& s, Eigen::Index inducing, std::uint64_t seed, double ln_length) {
  return {s.x(drawnPoints(s.x.rows(), inducing, seed), Eigen::all), 2,
          KernelParameters{0.3, std::log(0.1), Eigen::VectorXd::Constant(1, ln_length), Kernel::kMatern}};
}

Committee learned(const Sample& s) {
  Committee committee(
      {knowingNothing(s, 40, 1, 0.2), knowingNothing(s, 50, 2, 0.4), knowingNothing(s, 60, 3, 0.6)});
  committee.add(s.x, s.y, Eigen::VectorXd::Zero(s.x.rows()));
  return committee;
}

TEST(Committee, SaysWhatAnEqualMixtureOfItsMembersDoes) {
  const Sample s = sample(300, 1), at = sample(20, 2);
  const Committee committee = learned(s);
  const Prediction commanded = committee.predict(at.x);
  EXPECT_LT((commanded.mean - committee.mean(at.x)).cwiseAbs().maxCoeff(), 1e-12);
  for (Eigen::Index k = 0; k < 20; ++k) {
    double first = 0.0, second = 0.0, output = 0.0;  // moments of both outputs
    for (const SparseProcess& member : committee.members()) {
      const Prediction own = member.predict(at.x.row(k));
      output += own.mean(0, 0) / 3.0;
      for (int q = 0; q < 2; ++q) second += (own.variance[0] + std::pow(own.mean(0, q), 2)) / 6.0;
    }
    for (int q = 0; q < 2; ++q) first += std::pow(commanded.mean(k, q), 2) / 2.0;
    EXPECT_NEAR(commanded.mean(k, 0), output, 1e-12);
    EXPECT_NEAR(commanded.variance[k], second - first, 1e-12);
  }
}

TEST(Committee, ItsCovarianceHasItsVariancesOnTheDiagonal) {
  const Sample s = sample(300, 1), at = sample(20, 2);
  const Committee committee = learned(s);
  const Eigen::MatrixXd covariance = committee.covariance(at.x);
  EXPECT_LT((covariance.diagonal() - committee.predict(at.x).variance).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((covariance - covariance.transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Committee, KnowsNothingFarFromAllData) {
  const Committee committee = learned(sample(300, 1));
  const Prediction commanded = committee.predict(Eigen::MatrixXd::Constant(1, 4, 100.0));
  EXPECT_LT(commanded.mean.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(commanded.variance[0], committee.signalVariance(), 1e-12);
}

/// Root mean square of what is left.
double leftBy(const Eigen::MatrixXd& commanded, const Eigen::MatrixXd& truth) {
  return std::sqrt((commanded - truth).squaredNorm() / static_cast<double>(truth.size()));
}

/// With hyperparameters from few points each, as the members have.
TEST(Committee, IsNearerThanItsMembers) {
  const Sample s = sample(1500, 1), at = sample(500, 2, 0.0);
  std::vector<SparseProcess> members;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto drawn = drawnPoints(s.x.rows(), 200, seed);
    const Eigen::MatrixXd x = s.x(drawn, Eigen::all), y = s.y(drawn, Eigen::all);
    const ProcessFitOptions fit{.kernel = Kernel::kMatern};
    members.emplace_back(s.x(drawnPoints(s.x.rows(), 60, 10 + seed), Eigen::all), 2,
                         fitProcess(x, y, startOf(x, y, fit), fit).parameters);
  }
  Committee committee(std::move(members));
  committee.add(s.x, s.y, Eigen::VectorXd::Zero(s.x.rows()));
  const double all = leftBy(committee.mean(at.x), at.y);
  for (const SparseProcess& member : committee.members())
    EXPECT_LT(all, 0.95 * leftBy(member.mean(at.x), at.y));
}

}  // namespace
}  // namespace capstan::learning
