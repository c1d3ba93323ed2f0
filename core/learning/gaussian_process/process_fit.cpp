#include "core/learning/gaussian_process/process_fit.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <cmath>

#include "core/learning/gaussian_process/marginal_likelihood.h"

namespace capstan::learning {
namespace {

/// Objective of the search: negative log likelihood with penalties.
class Cost : public ceres::FirstOrderFunction {
 public:
  Cost(MarginalLikelihood& likelihood, double steep, const KernelParameters& start,
       const ProcessFitOptions& options, const base::Progress* progress, int& evaluations)
      : likelihood_(likelihood),
        steep_(steep),
        start_(start.packed()),
        kernel_(start.kernel),
        options_(options),
        progress_(progress),
        evaluations_(evaluations) {}

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    if (progress_ && progress_->cancelled()) return false;
    const Eigen::Map<const Eigen::VectorXd> at(parameters, NumParameters());
    if (!((at - start_).cwiseAbs().maxCoeff() < kFarthest)) return false;
    ++evaluations_;
    Eigen::VectorXd slope;
    const auto value =
        likelihood_.negativeLog(KernelParameters::unpacked(at, kernel_), gradient ? &slope : nullptr);
    if (!value || !std::isfinite(*value)) return false;
    *cost = *value;
    fence(at, 0, options_.farthest_signal, *cost, gradient ? &slope : nullptr);
    fence(at, 1, options_.farthest_noise, *cost, gradient ? &slope : nullptr);
    if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, NumParameters()) = slope;
    return true;
  }
  int NumParameters() const override { return static_cast<int>(start_.size()); }

 private:
  /// Adds a steep penalty beyond the distance `farthest` from the start.
  void fence(const Eigen::Map<const Eigen::VectorXd>& at, Eigen::Index k, double farthest, double& cost,
             Eigen::VectorXd* slope) const {
    const double way = at[k] - start_[k], beyond = std::abs(way) - farthest;
    if (beyond <= 0.0) return;
    cost += steep_ * beyond * beyond;
    if (slope) (*slope)[k] += std::copysign(2.0 * steep_ * beyond, way);
  }

  MarginalLikelihood& likelihood_;
  double steep_;  ///< factor of the penalties
  Eigen::VectorXd start_;
  Kernel kernel_;
  const ProcessFitOptions& options_;
  const base::Progress* progress_;
  int& evaluations_;
};

/// Standard deviation of a column.
double deviationOf(const Eigen::VectorXd& column) {
  return std::sqrt((column.array() - column.mean()).square().mean());
}

}  // namespace

KernelParameters startOf(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y,
                         const ProcessFitOptions& options) {
  constexpr double kLengths = 2.0, kNoise = 0.1;
  const auto lnOf = [](double value) { return std::log(value > 0.0 ? value : 1.0); };
  KernelParameters start;
  start.kernel = options.kernel;
  start.ln_signal = 0.5 * lnOf(y.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(y.size(), 1)));
  start.ln_noise = start.ln_signal + std::log(kNoise);
  Eigen::VectorXd lengths(x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) lengths[i] = lnOf(kLengths * deviationOf(x.col(i)));
  start.ln_length = lengths;
  return start;
}

ProcessFitReport fitProcess(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const KernelParameters& start,
                            const ProcessFitOptions& options, const base::Progress* progress) {
  ProcessFitReport report;
  Eigen::VectorXd found = start.packed();
  MarginalLikelihood likelihood(x, y);
  const ceres::GradientProblem problem(
      new Cost(likelihood, static_cast<double>(x.rows()), start, options, progress, report.evaluations));
  ceres::GradientProblemSolver::Options search;
  search.line_search_direction_type = ceres::BFGS;
  search.max_num_iterations = options.iterations;
  search.function_tolerance = options.tolerance;
  search.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(search, problem, found.data(), &summary);
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.parameters = found.allFinite() ? KernelParameters::unpacked(found, start.kernel) : start;
  report.negative_log_likelihood =
      likelihood.negativeLog(report.parameters, nullptr).value_or(summary.final_cost);
  return report;
}

}  // namespace capstan::learning
