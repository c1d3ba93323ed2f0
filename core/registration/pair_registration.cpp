#include "core/registration/pair_registration.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

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
constexpr double kOtherUnit = 0.3;        // |log of the scale| by which no calibration is wrong
constexpr double kMirrorGain = 0.1;       // of the trimmed squares; coplanar points give about 1
constexpr double kLeastVariance = 1e-10;  // (0.01 mm)²: rounded digits are no reason to reject a pair [m²]
constexpr double kLargestTurn = 0.05;     // standard deviation of the rotation [rad]: 5 mm at 0.1 m
constexpr double kLargestSigma =
    0.3;  // of the points' spread per axis; a fit of unrelated points leaves about 0.8
constexpr double kIsotropicPairs = 10.0;       // weight of equal variances on all axes, in pairs
constexpr double kFalseRejection = 0.01;       // per set of pairs
constexpr double kMedianOfChiSquare3 = 2.366;  // median of χ² with three degrees of freedom

struct Pairs {
  std::span<const PointPair> all;
  std::size_t size() const { return all.size(); }

  std::optional<Eigen::Isometry3d> fit(const Rows& rows) const {
    Points camera, base;
    for (std::size_t row : rows) {
      camera.push_back(all[row].camera);
      base.push_back(all[row].base);
    }
    const auto fitted = vision::registerRigid(camera, base);
    if (!fitted) return std::nullopt;
    return fitted->base_from_camera;
  }
  Eigen::Vector3d residual(const Eigen::Isometry3d& base_from_camera, std::size_t row) const {
    return all[row].base - base_from_camera * all[row].camera;
  }
  double squared(const Eigen::Isometry3d& base_from_camera, std::size_t row) const {
    return residual(base_from_camera, row).squaredNorm();
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

// Scale of the base frame's lengths by the shortest interval that contains a quarter of the ratios of all
// distances: distances between outliers, which are fewer than half of the pairs, scatter widely.
double roughScale(const Pairs& pairs) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double camera = (pairs.all[i].camera - pairs.all[j].camera).norm();
      const double base = (pairs.all[i].base - pairs.all[j].base).norm();
      if (camera > 0.0 && base > 0.0) ratios.push_back(std::log(base / camera));
    }
  if (ratios.empty()) return 1.0;
  std::ranges::sort(ratios);
  const std::size_t quarter = ratios.size() / 4;
  std::size_t first = 0;
  for (std::size_t i = 0; i + quarter < ratios.size(); ++i)
    if (ratios[i + quarter] - ratios[i] < ratios[first + quarter] - ratios[first]) first = i;
  return std::exp(0.5 * (ratios[first] + ratios[first + quarter]));
}

// Scale of the least squares fit of `rows` that may also scale (Umeyama 1991), at the rotation of `fit`.
double scaleOf(const Pairs& pairs, const Rows& rows, const Eigen::Isometry3d& fit) {
  Eigen::Vector3d camera = Eigen::Vector3d::Zero(), base = Eigen::Vector3d::Zero();
  for (std::size_t row : rows) {
    camera += pairs.all[row].camera / static_cast<double>(rows.size());
    base += pairs.all[row].base / static_cast<double>(rows.size());
  }
  double along = 0.0, squares = 0.0;
  for (std::size_t row : rows) {
    const Eigen::Vector3d arm = fit.rotation() * (pairs.all[row].camera - camera);
    along += arm.dot(pairs.all[row].base - base);
    squares += arm.squaredNorm();
  }
  return along / squares;
}

bool isMirrored(const Pairs& pairs, double trimmed_sum) {
  std::vector<PointPair> mirrored(pairs.all.begin(), pairs.all.end());
  for (auto& pair : mirrored) pair.camera.z() = -pair.camera.z();
  const auto fit = fitTrimmed({mirrored});
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
    const auto derivative = jacobian(fit.rotation() * pairs.all[row].camera);
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
  const double limit = 3.0 * quantile(complement(ratio, level)) * std::max(sum / freedom, kLeastVariance);
  const auto cofactors = cofactorsOf(pairs, rows, fit);
  Rows kept;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto derivative = jacobian(fit.rotation() * pairs.all[i].camera);
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

double largestShift(const Pairs& pairs, const Rows& rows, const Eigen::Isometry3d& from,
                    const Eigen::Isometry3d& to) {
  double largest = 0.0;
  for (std::size_t row : rows)
    largest = std::max(largest, (to * pairs.all[row].camera - from * pairs.all[row].camera).norm());
  return largest;
}

// Fits the rows without each in turn.
void leaveOneOut(const Pairs& pairs, const Rows& rows, PairRegistration& result) {
  result.shifts.assign(pairs.size(), 0.0);
  double sum = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Rows others = rows;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const auto fit = pairs.fit(others);
    sum += fit ? pairs.squared(*fit, rows[k]) : std::nan("");
    result.shifts[rows[k]] = fit ? largestShift(pairs, rows, result.base_from_camera, *fit) : std::nan("");
  }
  result.leave_one_out_rms = std::sqrt(sum / static_cast<double>(rows.size()));
}

// RMS distance of the points in the base frame from their mean, per axis.
double spreadOf(const Pairs& pairs, const Rows& rows) {
  const auto count = static_cast<double>(rows.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (std::size_t row : rows) mean += pairs.all[row].base / count;
  for (std::size_t row : rows) sum += (pairs.all[row].base - mean).squaredNorm();
  return std::sqrt(sum / (3.0 * count));
}

// Covariance of a pair's residual in base axes, equal in camera axes for all pairs. The isotropic estimate
// counts as much as kIsotropicPairs pairs: few pairs do not show a shape.
Eigen::Matrix3d residualCovariance(const Pairs& pairs, const Rows& rows, const Eigen::Isometry3d& fit,
                                   double sigma) {
  Eigen::Matrix3d sum = kIsotropicPairs * sigma * sigma * Eigen::Matrix3d::Identity();
  for (std::size_t row : rows) {
    const Eigen::Vector3d residual = pairs.residual(fit, row);
    sum += residual * residual.transpose();
  }
  return sum / (kIsotropicPairs + static_cast<double>(rows.size()) - 2.0);
}

// Covariance of the least squares fit for residuals of that covariance.
Eigen::Matrix<double, 6, 6> covarianceOf(const Pairs& pairs, const Rows& rows, const Eigen::Isometry3d& fit,
                                         double sigma) {
  const Eigen::Matrix3d residual = residualCovariance(pairs, rows, fit, sigma);
  const auto cofactors = cofactorsOf(pairs, rows, fit);
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t row : rows) {
    const auto derivative = jacobian(fit.rotation() * pairs.all[row].camera);
    sum += derivative.transpose() * residual * derivative;
  }
  return cofactors * sum * cofactors;
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
  result.covariance = covarianceOf(pairs, rows, fit, result.sigma);
  leaveOneOut(pairs, rows, result);
  return result;
}

}  // namespace

double sigmaAt(const PairRegistration& registration, const Eigen::Vector3d& camera) {
  const auto derivative = jacobian(registration.base_from_camera.rotation() * camera);
  return std::sqrt((derivative * registration.covariance * derivative.transpose()).trace());
}

double error95At(const PairRegistration& registration, const Eigen::Vector3d& camera) {
  const auto used = static_cast<double>(std::ranges::count(registration.used, true));
  const boost::math::students_t_distribution<double> t(used - 2.0);
  return quantile(complement(t, 0.025)) * sigmaAt(registration, camera);
}

base::Result<PairRegistration, PairRefusal> registerPairs(std::span<const PointPair> all) {
  const Pairs pairs{all};
  if (pairs.size() < kFewest)
    return base::failure(PairRefusal{PairFault::kTooFewPairs, static_cast<double>(pairs.size())});
  const auto trimmed = fitTrimmed(pairs);
  if (!trimmed) return base::failure(PairRefusal{PairFault::kCollinear, 0.0});
  const double rough = roughScale(pairs);
  if (std::abs(std::log(rough)) > kOtherUnit) return base::failure(PairRefusal{PairFault::kScale, rough});
  if (isMirrored(pairs, trimmed->sum)) return base::failure(PairRefusal{PairFault::kMirrored, 0.0});
  const auto fit = pairs.fit(trimmed->rows);
  if (!fit) return base::failure(PairRefusal{PairFault::kCollinear, 0.0});
  // Start: within three median standard deviations per axis, which the tests then correct.
  const double start = 27.0 * std::max(trimmed->median, kLeastVariance) / kMedianOfChiSquare3;
  const auto found = agreementFrom(pairs, agreeing(pairs, *fit, start));
  if (!found) return base::failure(found.error());
  PairRegistration result = registrationOf(pairs, found->rows, found->fit);
  if (result.sigma > kLargestSigma * spreadOf(pairs, found->rows))
    return base::failure(PairRefusal{PairFault::kScatter, result.sigma});
  const double scale = scaleOf(pairs, found->rows, found->fit);
  if (std::abs(scale - 1.0) > kScaleTolerance) return base::failure(PairRefusal{PairFault::kScale, scale});
  const double turn = std::sqrt(result.covariance.topLeftCorner<3, 3>().eigenvalues().real().maxCoeff());
  if (turn > kLargestTurn) return base::failure(PairRefusal{PairFault::kTooClose, turn});
  return result;
}

}  // namespace capstan::registration
