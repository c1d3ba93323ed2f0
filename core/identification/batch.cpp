#include "core/identification/batch.h"

#include <ceres/ceres.h>

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/estimation/occlusion_gate.h"
#include "core/identification/solver_end.h"
#include "core/stats/chi_square.h"
#include "core/stats/quantile.h"

namespace capstan::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostBatchIterations = 30;  // most steps of the solver per stage

/// Evaluates the whole recording once per step of the solver; the residual blocks read the result.
class Evaluation final : public ceres::EvaluationCallback {
 public:
  Evaluation(OutputError& problem, const VectorXd& x, base::Progress* progress)
      : problem_(problem), x_(x), progress_(progress) {}

  void PrepareForEvaluation(bool jacobians, bool new_point) override {
    if (!new_point && (!jacobians || has_jacobian_)) return;
    cancelled_ = cancelled_ || !problem_.evaluate(x_, residuals, jacobians ? &jacobian : nullptr, progress_);
    has_jacobian_ = jacobians;
  }
  bool cancelled() const { return cancelled_; }

  VectorXd residuals;
  MatrixXd jacobian;

 private:
  OutputError& problem_;
  const VectorXd& x_;
  base::Progress* progress_;
  bool has_jacobian_ = false, cancelled_ = false;
};

/// The three residuals of one observation.
class ObservationBlock final : public ceres::CostFunction {
 public:
  ObservationBlock(const Evaluation& evaluation, int k, int unknowns) : evaluation_(evaluation), k_(k) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->push_back(unknowns);
  }
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (evaluation_.cancelled()) return false;
    Eigen::Map<Eigen::Vector3d>(residuals, 3) = evaluation_.residuals.segment<3>(3 * k_);
    if (jacobians && jacobians[0])
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], 3, evaluation_.jacobian.cols()) = evaluation_.jacobian.middleRows<3>(3 * k_);
    return true;
  }

 private:
  const Evaluation& evaluation_;
  int k_;
};

/// The prior as residuals x.
class PriorBlock final : public ceres::CostFunction {
 public:
  explicit PriorBlock(int unknowns) {
    set_num_residuals(unknowns);
    mutable_parameter_block_sizes()->push_back(unknowns);
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const int n = num_residuals();
    std::copy(x[0], x[0] + n, residuals);
    if (jacobians && jacobians[0]) Eigen::Map<MatrixXd>(jacobians[0], n, n).setIdentity();
    return true;
  }
};

class BatchWatch final : public ceres::IterationCallback {
 public:
  BatchWatch(base::Progress* progress, int most) : progress_(progress), most_(most) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (!progress_) return ceres::SOLVER_CONTINUE;
    progress_->report(std::min(1.0, (summary.iteration + 1.0) / most_), "batch identification");
    return progress_->cancelled() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  base::Progress* progress_;
  int most_;
};

double rmsOf(const VectorXd& residuals) {
  return residuals.size() > 0 ? std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()))
                              : 0.0;
}

ceres::Solver::Summary solve(OutputError& error, const ParameterSet& set, VectorXd& x, double huber,
                             base::Progress* progress) {
  Evaluation evaluation(error, x, progress);
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &evaluation;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::HuberLoss loss(huber);
  ceres::Problem problem(problem_options);
  for (int k = 0; k < error.observations(); ++k)
    problem.AddResidualBlock(new ObservationBlock(evaluation, k, error.unknowns()), &loss, x.data());
  problem.AddResidualBlock(new PriorBlock(error.unknowns()), nullptr, x.data());
  for (int i = 0; i < set.size(); ++i) {
    problem.SetParameterLowerBound(x.data(), i, -set[i].bound / set[i].prior_sigma);
    problem.SetParameterUpperBound(x.data(), i, set[i].bound / set[i].prior_sigma);
  }
  BatchWatch watch(progress, kMostBatchIterations);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = kMostBatchIterations;
  solver.initial_trust_region_radius = 100.0;  // Ceres divides the damping by it
  solver.function_tolerance = 1e-7;
  solver.parameter_tolerance = 1e-6;
  solver.logging_type = ceres::SILENT;
  solver.callbacks.push_back(&watch);
  solver.update_state_every_iteration = true;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary;
}

/// Huber's limit for a fit that is still poor: kHuberLimit times the robust standard deviation of the
/// residuals (from their median), at least kHuberLimit.
double limitFor(const VectorXd& residuals) {
  std::vector<double> sizes;
  for (Eigen::Index k = 0; k < residuals.size(); k += 3) sizes.push_back(residuals.segment<3>(k).norm());
  const double expected = std::sqrt(stats::chiSquareQuantile(3, 0.5));
  return kHuberLimit * std::max(1.0, stats::median(sizes) / expected);
}

/// Fits the camera pose to the residuals at the parameters of x, by reweighted Gauss–Newton steps that need
/// no new predictions. Without this step, a registration error of millimetres would make every observation an
/// outlier.
void alignCamera(const OutputError& error, int parameters, VectorXd& x, VectorXd& residuals,
                 MatrixXd& jacobian) {
  constexpr int kSteps = 8;
  constexpr int kPose = CameraPose::kSize;
  for (int step = 0; step < kSteps; ++step) {
    error.compare(x, residuals, &jacobian);
    const double limit = limitFor(residuals);
    MatrixXd normal = MatrixXd::Identity(kPose, kPose);
    VectorXd gradient = x.tail(kPose);
    for (Eigen::Index k = 0; k < residuals.size(); k += 3) {
      const double weight = std::min(1.0, limit / std::max(limit, residuals.segment<3>(k).norm()));
      const MatrixXd rows = jacobian.block(k, parameters, 3, kPose);
      normal.noalias() += weight * rows.transpose() * rows;
      gradient.noalias() += weight * rows.transpose() * residuals.segment<3>(k);
    }
    x.tail(kPose) -= normal.llt().solve(gradient);
  }
  error.compare(x, residuals, &jacobian);
}

/// Solves in stages. Huber's limit falls to kHuberLimit as the fit improves.
BatchEnd fit(OutputError& error, const ParameterSet& set, VectorXd& x, VectorXd& residuals,
             MatrixXd& jacobian, int& iterations, base::Progress* progress) {
  constexpr int kMostStages = 5;
  alignCamera(error, set.size(), x, residuals, jacobian);
  BatchEnd end = BatchEnd::kFailed;
  for (int stage = 0; stage < kMostStages; ++stage) {
    const double limit = limitFor(residuals);
    const ceres::Solver::Summary summary = solve(error, set, x, limit, progress);
    end = endOf(summary, progress);
    iterations += static_cast<int>(summary.iterations.size());
    if (end == BatchEnd::kCancelled || !error.evaluate(x, residuals, &jacobian, progress))
      return BatchEnd::kCancelled;
    if (end == BatchEnd::kFailed || limitFor(residuals) > 0.9 * limit) break;
  }
  return end;
}

/// Information of the observations at the solution; see identifyBatch().
struct Information {
  MatrixXd hessian;      ///< Jᵀ W J + 1
  MatrixXd meat;         ///< Σ_b g_b g_bᵀ
  MatrixXd discrepancy;  ///< Σ_d G_d G_dᵀ + G_h G_hᵀ
  int blocks = 1;
};

Information informationOf(const OutputError& error, const ParameterSet& set, const VectorXd& x,
                          const VectorXd& residuals, const MatrixXd& jacobian,
                          const ModelDiscrepancy& discrepancy) {
  const int n = error.unknowns();
  Information all{MatrixXd::Identity(n, n), MatrixXd::Zero(n, n), MatrixXd::Zero(n, n)};
  VectorXd gradient = VectorXd::Zero(n);
  MatrixXd by_discrepancy = MatrixXd::Zero(n, 3), by_hysteresis = by_discrepancy;
  const tracking::CableArmConstants constants = set.constants(error.logs(x));
  const Eigen::Matrix3d unknown = errorByDiscrepancy(constants, discrepancy);
  double start = error.observation(0).t, discrepancy_start = start;
  for (int k = 0; k < error.observations(); ++k) {
    const double t = error.observation(k).t;
    const bool fresh = k > 0 && !error.shooting().continues(static_cast<std::size_t>(k));
    if (fresh || t - start >= kCorrelationBlock) {
      all.meat += gradient * gradient.transpose();
      gradient.setZero();
      start = t;
      ++all.blocks;
    }
    if (fresh || t - discrepancy_start >= ModelDiscrepancy::kMemory) {
      all.discrepancy += by_discrepancy * by_discrepancy.transpose();
      by_discrepancy.setZero();
      discrepancy_start = t;
    }
    const double size = residuals.segment<3>(3 * k).norm();
    const double weight = size > kHuberLimit ? kHuberLimit / size : 1.0;
    const auto rows = jacobian.middleRows<3>(3 * k);
    all.hessian.noalias() += weight * rows.transpose() * rows;
    gradient += weight * rows.transpose() * residuals.segment<3>(3 * k);
    const MatrixXd by_joint = weight * rows.transpose() * error.residualByJoint(x, k);
    by_discrepancy += by_joint * unknown;
    const auto& arm = error.predictions()[static_cast<std::size_t>(k)];
    by_hysteresis += by_joint * errorByHysteresis(constants, discrepancy, arm.hysteresis);
  }
  all.meat += gradient * gradient.transpose();
  all.discrepancy += by_discrepancy * by_discrepancy.transpose() + by_hysteresis * by_hysteresis.transpose();
  return all;
}

/// Covariance of the unknowns at the solution; see identifyBatch().
MatrixXd covarianceOf(const Information& found) {
  const auto n = static_cast<int>(found.hessian.rows());
  const MatrixXd inverse = found.hessian.inverse();
  const MatrixXd plain = inverse + inverse * found.discrepancy * inverse;
  const double few = found.blocks / std::max(0.5 * found.blocks, static_cast<double>(found.blocks - n));
  const MatrixXd sandwich = inverse * (few * found.meat + MatrixXd::Identity(n, n)) * inverse;
  const auto byPlain = [&](int i) { return plain(i, i) >= sandwich(i, i); };
  VectorXd sigma(n);
  for (int i = 0; i < n; ++i) sigma(i) = std::sqrt(std::min(1.0, std::max(plain(i, i), sandwich(i, i))));
  MatrixXd covariance(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const MatrixXd& from = byPlain(i) && byPlain(j) ? plain : sandwich;
      covariance(i, j) = sigma(i) * sigma(j) * from(i, j) / std::sqrt(from(i, i) * from(j, j));
    }
  return covariance;
}

void describe(const OutputError& error, const ParameterSet& set, const VectorXd& x, const MatrixXd& jacobian,
              const MatrixXd& covariance, BatchReport& report) {
  const int n = set.size();
  const VectorXd sigma = error.scale().cwiseProduct(covariance.diagonal().cwiseSqrt());
  report.covariance = error.scale().head(n).asDiagonal() * covariance.topLeftCorner(n, n) *
                      error.scale().head(n).asDiagonal();
  const VectorXd inverse = covariance.diagonal().head(n).cwiseSqrt().cwiseInverse();
  report.correlation = inverse.asDiagonal() * covariance.topLeftCorner(n, n) * inverse.asDiagonal();
  report.camera = error.pose(x);
  report.camera_sigma = cameraPoseOf(sigma.tail<CameraPose::kSize>());
  const Identifiability after = assess(error, set, jacobian);
  for (int i = 0; i < n; ++i) {
    Visibility visibility = after.parameters[static_cast<std::size_t>(i)];
    visibility.stated = sigma(i);
    visibility.seen = sigma(i) < kSeenShare * set[i].prior_sigma;
    Estimate estimate{set[i], error.scale()(i) * x(i), sigma(i), visibility.seen, {}, {}};
    if (!estimate.seen || estimate.sigma > set[i].goal) {
      estimate.weakness = weaknessOf(set, i, visibility, report.observations);
      estimate.advice = adviceFor(set, i, visibility, report.observations);
    }
    if (estimate.seen && std::abs(estimate.log) > 0.999 * set[i].bound)
      estimate.advice = set[i].words() + " reached its bound. The model does not explain this recording.";
    report.estimates.push_back(estimate);
  }
}

}  // namespace

BatchReport identifyBatch(const IdentificationData& data, const ParameterSet& set,
                          const BatchOptions& options, base::Progress* progress) {
  const auto begin = std::chrono::steady_clock::now();
  BatchReport report;
  OutputError error(data, set, options.camera, options.shooting);
  const int n = error.unknowns();
  report.observations = error.observations();
  VectorXd x = VectorXd::Zero(n), residuals;
  MatrixXd jacobian, covariance = MatrixXd::Identity(n, n);
  if (!error.evaluate(x, residuals, &jacobian, progress)) {
    report.end = BatchEnd::kCancelled;
    return report;
  }
  report.before = assess(error, set, jacobian);
  report.residual_before = rmsOf(residuals);
  report.end = BatchEnd::kNoData;
  for (std::size_t i = 0; i < options.start.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    x(row) = options.start[i] / error.scale()(row);
  }
  if (report.observations > 0) {
    if (!options.start.empty() && !error.evaluate(x, residuals, &jacobian, progress)) {
      report.end = BatchEnd::kCancelled;
      return report;
    }
    report.end = fit(error, set, x, residuals, jacobian, report.iterations, progress);
    if (report.end == BatchEnd::kCancelled) return report;
    const Information found = informationOf(error, set, x, residuals, jacobian, options.discrepancy);
    covariance = covarianceOf(found);
    report.delay_noise = error.scale()(n - 1) * std::sqrt(found.hessian.inverse()(n - 1, n - 1));
    report.residual_after = rmsOf(residuals);
    for (int k = 0; k < report.observations; ++k)
      report.outliers += residuals.segment<3>(3 * k).norm() > kHuberLimit ? 1.0 / report.observations : 0.0;
  }
  describe(error, set, x, jacobian, covariance, report);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

}  // namespace capstan::identification
