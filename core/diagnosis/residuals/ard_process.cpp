#include "core/diagnosis/residuals/ard_process.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <cmath>
#include <numbers>

namespace capstan::diagnosis {
namespace {

struct Prior {
  double centre, width;
};
Prior priorOf(Eigen::Index parameter) {
  if (parameter == kSignal) return {0.0, 2.0};
  if (parameter < kMemory) return {std::log(0.3), 2.0};
  return {parameter == kMemory ? std::log(0.3) : std::log(4.0), 1.5};
}

/// Adds −ln of the prior and its gradient.
double addPrior(const ProcessParameters& parameters, Eigen::VectorXd* gradient) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < parameters.size(); ++i) {
    const Prior prior = priorOf(i);
    const double away = (parameters(i) - prior.centre) / prior.width;
    sum += 0.5 * away * away;
    if (gradient) (*gradient)(i) += away / prior.width;
  }
  return sum;
}

class Problem : public ceres::FirstOrderFunction {
 public:
  Problem(const ArdProcess& process, const base::Progress* progress)
      : process_(process), progress_(progress) {}

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    if (progress_ && progress_->cancelled()) return false;
    const Eigen::Map<const Eigen::VectorXd> at(parameters, NumParameters());
    Eigen::VectorXd slope;
    const auto value = process_.objective(at, gradient ? &slope : nullptr);
    if (!value || !std::isfinite(*value)) return false;
    *cost = *value;
    if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, NumParameters()) = slope;
    return true;
  }
  int NumParameters() const override { return static_cast<int>(process_.parameters()); }

 private:
  const ArdProcess& process_;
  const base::Progress* progress_;
};

}  // namespace

double squaredDistance(double a, double b, bool angle) {
  const double d = angle ? 2.0 * std::sin(0.5 * (a - b)) : a - b;
  return d * d;
}

ArdProcess::ArdProcess(const ProcessInputs& inputs, Eigen::VectorXd y) : y_(std::move(y)) {
  const Eigen::Index n = inputs.size();
  for (Eigen::Index v = 0; v < inputs.variables(); ++v) {
    Eigen::MatrixXd& d = distances_.emplace_back(n, n);
    const bool angle = inputs.angle[static_cast<std::size_t>(v)];
    for (Eigen::Index c = 0; c < n; ++c)
      for (Eigen::Index r = 0; r < n; ++r) d(r, c) = squaredDistance(inputs.x(r, v), inputs.x(c, v), angle);
  }
  apart_.resize(n, n);
  for (Eigen::Index c = 0; c < n; ++c) apart_.col(c) = (inputs.t.array() - inputs.t(c)).abs();
}

Eigen::MatrixXd ArdProcess::signalCovariance(const ProcessParameters& parameters) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(y_.size(), y_.size());
  for (std::size_t v = 0; v < distances_.size(); ++v)
    sum += std::exp(-2.0 * parameters(kLengths + static_cast<Eigen::Index>(v))) * distances_[v];
  return (std::exp(2.0 * parameters(kSignal)) * (-0.5 * sum.array()).exp()).matrix();
}

Eigen::MatrixXd ArdProcess::slowCovariance(const ProcessParameters& parameters) const {
  return std::exp(2.0 * parameters(kSlow)) * (-std::exp(-parameters(kMemory)) * apart_.array()).exp();
}

std::optional<double> ArdProcess::objective(const ProcessParameters& parameters,
                                            Eigen::VectorXd* gradient) const {
  const auto n = static_cast<double>(y_.size());
  const double noise = std::exp(2.0 * parameters(kWhite));
  const Eigen::MatrixXd signal = signalCovariance(parameters), slow = slowCovariance(parameters);
  Eigen::MatrixXd k = signal + slow;
  k.diagonal().array() += noise;
  const Eigen::LLT<Eigen::MatrixXd> root(k);
  if (root.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd alpha = root.solve(y_);
  const double value = 0.5 * y_.dot(alpha) + root.matrixLLT().diagonal().array().log().sum() +
                       0.5 * n * std::log(2.0 * std::numbers::pi);
  if (gradient) {
    // −∂ ln p / ∂θ = ½ tr((K⁻¹ − α αᵀ) ∂K/∂θ), (5.9)
    Eigen::MatrixXd w = root.solve(Eigen::MatrixXd::Identity(y_.size(), y_.size()));
    w.noalias() -= alpha * alpha.transpose();
    gradient->setZero(parameters.size());
    (*gradient)(kWhite) = noise * w.trace();
    const Eigen::MatrixXd w_slow = w.cwiseProduct(slow);
    (*gradient)(kSlow) = w_slow.sum();
    (*gradient)(kMemory) = 0.5 * std::exp(-parameters(kMemory)) * w_slow.cwiseProduct(apart_).sum();
    w.array() *= signal.array();
    (*gradient)(kSignal) = w.sum();
    for (std::size_t v = 0; v < distances_.size(); ++v) {
      const auto i = kLengths + static_cast<Eigen::Index>(v);
      (*gradient)(i) = 0.5 * std::exp(-2.0 * parameters(i)) * w.cwiseProduct(distances_[v]).sum();
    }
  }
  return value + addPrior(parameters, gradient);
}

ProcessParameters ArdProcess::fit(const ProcessParameters& start, int iterations,
                                  const base::Progress* progress) const {
  if (!objective(start, nullptr)) return start;
  const ceres::GradientProblem problem(new Problem(*this, progress));
  ceres::GradientProblemSolver::Options options;
  options.max_num_iterations = iterations;
  options.line_search_direction_type = ceres::BFGS;
  options.function_tolerance = 1e-6;
  options.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  ProcessParameters found = start;
  ceres::Solve(options, problem, found.data(), &summary);
  return found.allFinite() && summary.final_cost <= summary.initial_cost ? found : start;
}

Eigen::VectorXd ArdProcess::weights(const ProcessParameters& parameters) const {
  Eigen::MatrixXd k = signalCovariance(parameters) + slowCovariance(parameters);
  k.diagonal().array() += std::exp(2.0 * parameters(kWhite));
  const Eigen::LLT<Eigen::MatrixXd> root(k);
  if (root.info() != Eigen::Success) return Eigen::VectorXd::Zero(y_.size());
  return root.solve(y_);
}

Eigen::MatrixXd scaledDistances(const ProcessInputs& at, const ProcessInputs& known,
                                const ProcessParameters& parameters) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(at.size(), known.size());
  for (Eigen::Index v = 0; v < at.variables(); ++v) {
    const double scale = std::exp(-2.0 * parameters(kLengths + v));
    const bool angle = at.angle[static_cast<std::size_t>(v)];
    for (Eigen::Index c = 0; c < known.size(); ++c)
      for (Eigen::Index r = 0; r < at.size(); ++r)
        sum(r, c) += scale * squaredDistance(at.x(r, v), known.x(c, v), angle);
  }
  return sum;
}

}  // namespace capstan::diagnosis
