#include "core/diagnosis/evidence/smooth_readings.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

constexpr Index kSegment = 50;      // readings per segment that is compared with the noise
constexpr double kMostOften = 0.9;  // share of the segments that must be within noise
constexpr double kSlack = 1.1;      // their limit, times noise: the RMS of a short segment scatters itself
constexpr double kMost = 2.0;  // limit of any segment, times noise: rest beside an encoder's step has √3
constexpr double kFastest = 1.0, kSlowest = 0.01;  // cut-off of the smoother [rad per reading]
constexpr int kHalvings = 6;                       // bisections of the cut-off between these two

/// Matrix of the third differences Δ³ of n readings.
Matrix thirdDifferences(Index n) {
  Matrix d(n - 3, n);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(4 * (n - 3)));
  for (Index k = 0; k < n - 3; ++k) {
    const double row[] = {-1.0, 3.0, -3.0, 1.0};
    for (Index i = 0; i < 4; ++i) entries.emplace_back(k, k + i, row[i]);
  }
  d.setFromTriplets(entries.begin(), entries.end());
  return d;
}

/// True if the residual is within noise: the share kMostOften of its segments by kSlack, all by kMost.
bool isNoise(const VectorXd& residual, double noise) {
  std::vector<double> errors;
  for (Index k = 0; k + kSegment <= residual.size(); k += kSegment)
    errors.push_back(std::sqrt(residual.segment(k, kSegment).squaredNorm() / kSegment));
  const Index last = std::min(kSegment, residual.size());
  errors.push_back(std::sqrt(residual.tail(last).squaredNorm() / static_cast<double>(last)));
  return stats::quantile(errors, kMostOften) <= kSlack * noise &&
         *std::max_element(errors.begin(), errors.end()) <= kMost * noise;
}

class Whittaker {
 public:
  explicit Whittaker(Index n) : identity_(n, n) {
    identity_.setIdentity();
    const Matrix d = thirdDifferences(n);
    roughness_ = d.transpose() * d;
    solver_.analyzePattern(Matrix(identity_ + roughness_));
  }

  /// Smoothed readings. `cutoff` is the frequency with half the amplitude [rad per reading]; λ = cutoff⁻⁶.
  VectorXd operator()(const VectorXd& readings, double cutoff) {
    solver_.factorize(Matrix(identity_ + std::pow(cutoff, -6.0) * roughness_));
    return solver_.solve(readings);
  }

 private:
  Matrix identity_, roughness_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<int>> solver_;
};

}  // namespace

std::vector<double> smoothReadings(std::span<const double> readings, double noise) {
  std::vector<double> result(readings.begin(), readings.end());
  const auto n = static_cast<Index>(readings.size());
  if (n < 8 || !(noise > 0.0)) return result;
  const double origin = readings.front();
  const VectorXd y = Eigen::Map<const VectorXd>(readings.data(), n).array() - origin;
  Whittaker smooth(n);
  double low = std::log(kSlowest), high = std::log(kFastest);
  VectorXd best = y;
  for (int k = 0; k <= kHalvings; ++k) {
    const double middle = k == 0 ? high : 0.5 * (low + high);
    const VectorXd x = smooth(y, std::exp(middle));
    const bool within = isNoise(y - x, noise);
    if (within) best = x;
    if (k == 0 && !within) break;  // even the weakest smoothing removes more than noise
    (within ? high : low) = middle;
  }
  for (Index k = 0; k < n; ++k) result[static_cast<std::size_t>(k)] = origin + best[k];
  return result;
}

}  // namespace capstan::diagnosis
