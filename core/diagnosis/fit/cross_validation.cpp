#include "core/diagnosis/fit/cross_validation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/diagnosis/fit/free_system.h"
#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Residual of one channel, one run per block.
using Runs = std::vector<std::vector<double>>;

double covarianceAt(const Runs& runs, std::size_t lag) {
  double sum = 0.0, count = 0.0;
  for (const std::vector<double>& run : runs)
    for (std::size_t i = 0; i + lag < run.size(); ++i) sum += run[i] * run[i + lag], count += 1.0;
  return count > 0.0 ? sum / count : 0.0;
}

/// Correlation time in samples: 1 + 2 Σ ρ_k up to the first ρ_k that is not positive. The runs are not
/// centred, so that a non-zero mean counts as correlation.
double correlationTime(const Runs& runs) {
  const double variance = covarianceAt(runs, 0);
  double time = 1.0;
  for (std::size_t lag = 1; variance > 0.0; ++lag) {
    const double rho = covarianceAt(runs, lag) / variance;
    if (!(rho > 0.0)) break;
    time += 2.0 * rho;
  }
  return time;
}

}  // namespace

double BlockSquares::meanSquare(Eigen::Index channel) const {
  const double n = count.row(channel).sum();
  return n > 0.0 ? sum.row(channel).sum() / n : 0.0;
}

BlockSquares squaresOf(const FitData& data, const VectorXd& e) {
  const auto channels = static_cast<Index>(data.channels().size());
  BlockSquares squares{MatrixXd::Zero(channels, data.blocks()), MatrixXd::Zero(channels, data.blocks()),
                       VectorXd::Ones(channels)};
  MatrixXd sum = MatrixXd::Zero(channels, data.blocks());
  std::vector<Runs> runs(static_cast<std::size_t>(channels), Runs(static_cast<std::size_t>(data.blocks())));
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    const double x = e[static_cast<Index>(i)];
    const int c = data.channel()[i], b = data.block()[i];
    squares.sum(c, b) += x * x;
    squares.count(c, b) += 1.0;
    sum(c, b) += x;
    runs[static_cast<std::size_t>(c)][static_cast<std::size_t>(b)].push_back(x);
  }
  for (Index c = 0; c < channels; ++c) {
    const double total = squares.sum.row(c).sum(), n = squares.count.row(c).sum();
    if (!(total > 0.0)) continue;
    const double between = sum.row(c).squaredNorm() / total;
    squares.inflation[c] = std::clamp(std::max(between, correlationTime(runs[static_cast<std::size_t>(c)])),
                                      1.0, std::max(1.0, n / 8.0));
  }
  return squares;
}

MatrixXd covarianceOf(const FitData& data, const Fit& fit, const Weighting& weighting) {
  const FreeSystem system(data, fit, weighting, false);
  const auto p = static_cast<Index>(system.free.size());
  const MatrixXd model = system.normal.ldlt().solve(MatrixXd::Identity(p, p));
  MatrixXd meat = MatrixXd::Zero(p, p);
  for (const std::vector<Index>& rows : system.rows) {
    if (rows.empty()) continue;
    const VectorXd score = system.jacobian(rows, Eigen::all).transpose() * system.e(rows);
    meat += score * score.transpose();
  }
  const double blocks = static_cast<double>(system.rows.size());
  MatrixXd sandwich = model * meat * model * (blocks / std::max(blocks - 1.0, 1.0));
  MatrixXd covariance = MatrixXd::Zero(fit.u.size(), fit.u.size());
  VectorXd inflation(p);
  for (Index k = 0; k < p; ++k) inflation[k] = std::sqrt(std::max(1.0, sandwich(k, k) / model(k, k)));
  const MatrixXd free = inflation.asDiagonal() * model * inflation.asDiagonal();
  for (Index i = 0; i < p; ++i)
    for (Index j = 0; j < p; ++j)
      covariance(system.free[static_cast<std::size_t>(i)], system.free[static_cast<std::size_t>(j)]) =
          free(i, j);
  return covariance;
}

Reduction largestReduction(const BlockSquares& worse, const BlockSquares& better) {
  constexpr double kNone = -1e9;
  Reduction largest{kNone, 0};
  for (Index c = 0; c < worse.sum.rows(); ++c) {
    const double before = worse.sum.row(c).sum(), after = better.sum.row(c).sum();
    if (before > 0.0 && 1.0 - after / before > largest.share)
      largest = {1.0 - after / before, static_cast<int>(c)};
  }
  return largest.share == kNone ? Reduction{} : largest;
}

}  // namespace capstan::diagnosis
