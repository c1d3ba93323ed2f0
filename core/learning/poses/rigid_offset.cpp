#include "core/learning/poses/rigid_offset.h"

#include <Eigen/SVD>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

std::vector<double> squaredDistances(std::span<const PosePair> pairs, const Eigen::Isometry3d& offset,
                                     double lever) {
  std::vector<double> squares;
  squares.reserve(pairs.size());
  for (const PosePair& pair : pairs)
    squares.push_back(squaredDistance(offset * pair.observed, pair.commanded, lever));
  return squares;
}

}  // namespace

double squaredDistance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double lever) {
  const double angle = Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
  return (a.translation() - b.translation()).squaredNorm() + std::pow(lever * angle, 2);
}

Eigen::Isometry3d rigidOffset(std::span<const PosePair> pairs, double lever) {
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  if (pairs.empty()) return offset;
  Eigen::Vector3d observed = Eigen::Vector3d::Zero(), commanded = observed;
  for (const PosePair& pair : pairs)
    observed += pair.observed.translation(), commanded += pair.commanded.translation();
  observed /= static_cast<double>(pairs.size());
  commanded /= static_cast<double>(pairs.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const PosePair& pair : pairs)
    sum += (pair.commanded.translation() - commanded) * (pair.observed.translation() - observed).transpose() /
               (lever * lever) +
           pair.commanded.linear() * pair.observed.linear().transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double rotated = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  offset.linear() =
      svd.matrixU() * Eigen::Vector3d(1.0, 1.0, rotated).asDiagonal() * svd.matrixV().transpose();
  offset.translation() = commanded - offset.linear() * observed;
  return offset;
}

MedianReport leastMedianOffset(std::span<const PosePair> pairs, const MedianOptions& options) {
  MedianReport report;
  report.belongs.assign(pairs.size(), true);
  constexpr std::size_t kSample = MedianOptions::kSample;
  if (pairs.size() <= kSample) {
    report.offset = rigidOffset(pairs, kLever);
    return report;
  }
  base::Random random(options.seed, "least median of squares");
  double least = std::numeric_limits<double>::infinity();
  std::vector<PosePair> drawn(kSample);
  for (int draw = 0; draw < MedianOptions::kDraws; ++draw) {
    for (PosePair& pair : drawn) pair = pairs[random.bits() % pairs.size()];
    const Eigen::Isometry3d offset = rigidOffset(drawn, kLever);
    const double median = stats::median(squaredDistances(pairs, offset, kLever));
    if (median < least) least = median, report.offset = offset;
  }
  const double n = static_cast<double>(pairs.size() - kSample);
  report.deviation = 1.4826 * (1.0 + 5.0 / n) * std::sqrt(least);
  const std::vector<double> squares = squaredDistances(pairs, report.offset, kLever);
  const double most = std::pow(MedianOptions::kReach * report.deviation, 2);
  std::vector<PosePair> belonging;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if ((report.belongs[k] = squares[k] <= most)) belonging.push_back(pairs[k]);
  report.offset = rigidOffset(belonging, kLever);
  return report;
}

}  // namespace capstan::learning
