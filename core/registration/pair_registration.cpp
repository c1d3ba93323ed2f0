#include "core/registration/pair_registration.h"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "core/stats/quantile.h"
#include "core/vision/registration.h"

namespace capstan::registration {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Rows = std::vector<std::size_t>;

constexpr std::size_t kFewest = 4;        // three pairs leave nothing by which to judge one
constexpr int kTriples = 300;             // P(no triple free of 40 % outliers) = 0.784^300 < 1e-31
constexpr int kConcentrations = 10;       // steps from a triple; most triples need fewer than five
constexpr int kTests = 20;                // of the pairs; most sets need fewer than five
constexpr double kScaleTolerance = 0.03;  // a wrong board or unit changes lengths by more
constexpr double kMirrorGain = 0.1;       // of the trimmed squares; coplanar points give about 1
constexpr double kLargestSigma =
    0.3;  // of the points' spread per axis; a fit of unrelated points leaves about 0.8
constexpr double kFalseRejection = 0.01;       // per set of pairs
constexpr double kMedianOfChiSquare3 = 2.366;  // median of χ² with three degrees of freedom

Points rowsOf(std::span<const Eigen::Vector3d> points, const Rows& rows) {
  Points some;
  for (std::size_t row : rows) some.push_back(points[row]);
  return some;
}

struct Pairs {
  std::span<const Eigen::Vector3d> camera, base;
  std::size_t size() const { return camera.size(); }

  std::optional<Eigen::Isometry3d> fit(const Rows& rows) const {
    const auto fitted = vision::registerRigid(rowsOf(camera, rows), rowsOf(base, rows));
    if (!fitted) return std::nullopt;
    return fitted->base_from_camera;
  }
  double squared(const Eigen::Isometry3d& base_from_camera, std::size_t row) const {
    return (base[row] - base_from_camera * camera[row]).squaredNorm();
  }
};

struct TrimmedFit {
  Rows rows;            // the half that agrees best
  double sum = 0.0;     // of its squared distances [m²]
  double median = 0.0;  // squared distance of all pairs [m²]
};

TrimmedFit nearestHalf(const Pairs& pairs, const Eigen::Isometry3d& base_from_camera) {
  std::vector<double> squares(pairs.size());
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = pairs.squared(base_from_camera, i);
  TrimmedFit half;
  half.rows.resize(pairs.size());
  std::iota(half.rows.begin(), half.rows.end(), 0);
  std::sort(half.rows.begin(), half.rows.end(), [&](auto a, auto b) { return squares[a] < squares[b]; });
  half.median = squares[half.rows[pairs.size() / 2]];
  half.rows.resize(pairs.size() / 2 + 1);
  for (std::size_t row : half.rows) half.sum += squares[row];
  return half;
}

std::optional<TrimmedFit> fitTrimmed(const Pairs& pairs) {
  std::mt19937 random(1);  // the same pairs give the same answer
  std::optional<TrimmedFit> best;
  Rows order(pairs.size());
  std::iota(order.begin(), order.end(), 0);
  for (int triple = 0; triple < kTriples; ++triple) {
    std::shuffle(order.begin(), order.end(), random);
    auto fit = pairs.fit(Rows(order.begin(), order.begin() + 3));
    std::optional<TrimmedFit> half;
    for (int step = 0; fit && step < kConcentrations; ++step) {
      TrimmedFit next = nearestHalf(pairs, *fit);
      if (half && next.sum >= half->sum) break;
      fit = pairs.fit(next.rows);
      half = std::move(next);
    }
    if (half && (!best || half->sum < best->sum)) best = half;
  }
  return best;
}

// Median over all pairs of points of the ratio of their distances. Outliers of up to 29 % leave it bounded.
double scaleOf(const Pairs& pairs) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double camera = (pairs.camera[i] - pairs.camera[j]).norm();
      if (camera > 0.0) ratios.push_back((pairs.base[i] - pairs.base[j]).norm() / camera);
    }
  return ratios.empty() ? 1.0 : stats::median(ratios);
}

bool isMirrored(const Pairs& pairs, double trimmed_sum) {
  Points mirrored(pairs.camera.begin(), pairs.camera.end());
  for (auto& point : mirrored) point.z() = -point.z();
  const auto fit = fitTrimmed({mirrored, pairs.base});
  return fit && fit->sum < kMirrorGain * trimmed_sum;
}

// Derivative of a pair's predicted position in the base frame by (rotation vector, translation).
Eigen::Matrix<double, 3, 6> jacobian(const Eigen::Vector3d& turned) {
  Eigen::Matrix<double, 3, 6> derivative;
  derivative << 0.0, turned.z(), -turned.y(), 1.0, 0.0, 0.0,  //
      -turned.z(), 0.0, turned.x(), 0.0, 1.0, 0.0,            //
      turned.y(), -turned.x(), 0.0, 0.0, 0.0, 1.0;
  return derivative;
}

Eigen::Matrix<double, 6, 6> cofactorsOf(const Pairs& pairs, const Rows& rows, const Eigen::Isometry3d& fit) {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t row : rows) {
    const auto derivative = jacobian(fit.rotation() * pairs.camera[row]);
    information += derivative.transpose() * derivative;
  }
  return information.inverse();
}

Rows agreeing(const Pairs& pairs, const Eigen::Isometry3d& fit, double limit) {
  Rows rows;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (pairs.squared(fit, i) <= limit) rows.push_back(i);
  return rows;
}

// The pairs that a fit of `rows` does not reject. A pair used pulls the fit towards itself, one not used does
// not: their variances differ from sigma² by the fit's own at that point.
Rows tested(const Pairs& pairs, const Rows& rows, const Eigen::Isometry3d& fit) {
  const auto freedom = 3.0 * static_cast<double>(rows.size()) - 6.0;
  double sum = 0.0;
  for (std::size_t row : rows) sum += pairs.squared(fit, row);
  const boost::math::fisher_f_distribution<double> ratio(3.0, freedom);
  const double level = kFalseRejection / static_cast<double>(pairs.size());
  const double limit = 3.0 * quantile(complement(ratio, level)) * sum / freedom;
  const auto cofactors = cofactorsOf(pairs, rows, fit);
  Rows kept;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto derivative = jacobian(fit.rotation() * pairs.camera[i]);
    const double own = (derivative * cofactors * derivative.transpose()).trace() / 3.0;
    const bool used = std::binary_search(rows.begin(), rows.end(), i);
    if (pairs.squared(fit, i) <= limit * (used ? 1.0 - own : 1.0 + own)) kept.push_back(i);
  }
  return kept;
}

struct Agreement {
  Rows rows;
  Eigen::Isometry3d fit = Eigen::Isometry3d::Identity();  // of these rows
};

// Fits and tests in turn until a test changes nothing.
base::Result<Agreement, PairRefusal> agreementFrom(const Pairs& pairs, Rows rows) {
  for (int round = 0;; ++round) {
    const auto fit = pairs.fit(rows);
    if (!fit) return base::failure(PairRefusal{PairFault::kCollinear, 0.0});
    if (2 * rows.size() <= pairs.size() || rows.size() < kFewest)
      return base::failure(PairRefusal{PairFault::kNoAgreement, static_cast<double>(rows.size())});
    Rows next = tested(pairs, rows, *fit);
    if (next == rows || next.size() < kFewest || round == kTests) return Agreement{rows, *fit};
    rows = std::move(next);
  }
}

double leaveOneOut(const Pairs& pairs, const Rows& rows) {
  double sum = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Rows others = rows;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const auto fit = pairs.fit(others);
    if (!fit) return std::nan("");
    sum += pairs.squared(*fit, rows[k]);
  }
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

// RMS distance of the points from their mean, per axis.
double spreadOf(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (const auto& point : points) mean += point / static_cast<double>(points.size());
  for (const auto& point : points) sum += (point - mean).squaredNorm();
  return std::sqrt(sum / (3.0 * static_cast<double>(points.size())));
}

PairRegistration registrationOf(const Pairs& pairs, const Rows& rows, const Eigen::Isometry3d& fit) {
  PairRegistration result;
  result.base_from_camera = fit;
  result.used.assign(pairs.size(), false);
  double sum = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) result.residuals.push_back(std::sqrt(pairs.squared(fit, i)));
  for (std::size_t row : rows) {
    result.used[row] = true;
    sum += pairs.squared(fit, row);
  }
  const auto count = static_cast<double>(rows.size());
  result.rms = std::sqrt(sum / count);
  result.sigma = std::sqrt(sum / (3.0 * count - 6.0));
  result.covariance = result.sigma * result.sigma * cofactorsOf(pairs, rows, fit);
  result.leave_one_out_rms = leaveOneOut(pairs, rows);
  return result;
}

}  // namespace

base::Result<PairRegistration, PairRefusal> registerPairs(std::span<const Eigen::Vector3d> camera,
                                                          std::span<const Eigen::Vector3d> base) {
  const Pairs pairs{camera, base};
  if (pairs.size() < kFewest || camera.size() != base.size())
    return base::failure(PairRefusal{PairFault::kTooFewPairs, static_cast<double>(pairs.size())});
  const auto trimmed = fitTrimmed(pairs);
  if (!trimmed) return base::failure(PairRefusal{PairFault::kCollinear, 0.0});
  const double scale = scaleOf(pairs);
  if (std::abs(scale - 1.0) > kScaleTolerance) return base::failure(PairRefusal{PairFault::kScale, scale});
  if (isMirrored(pairs, trimmed->sum)) return base::failure(PairRefusal{PairFault::kMirrored, 0.0});
  const auto fit = pairs.fit(trimmed->rows);
  if (!fit) return base::failure(PairRefusal{PairFault::kCollinear, 0.0});
  // Start: within three median standard deviations per axis, which the tests then correct.
  const double start = 27.0 * std::max(trimmed->median, 1e-24) / kMedianOfChiSquare3;
  const auto found = agreementFrom(pairs, agreeing(pairs, *fit, start));
  if (!found) return base::failure(found.error());
  PairRegistration result = registrationOf(pairs, found->rows, found->fit);
  if (result.sigma > kLargestSigma * spreadOf(rowsOf(base, found->rows)))
    return base::failure(PairRefusal{PairFault::kNoAgreement, static_cast<double>(found->rows.size())});
  return result;
}

}  // namespace capstan::registration
