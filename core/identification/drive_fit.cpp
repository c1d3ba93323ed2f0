#include "core/identification/drive_fit.h"

#include <ceres/ceres.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/identification/solver_end.h"
#include "core/stats/quantile.h"

namespace capstan::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Jet = ceres::Jet<double, kDriveQuantities>;

constexpr int kMostDriveIterations = 60;  // most steps of the solver per round

/// Huber's loss as a residual r̃ with r̃² = 2 ρ(r): r within the limit c, sgn(r) √(2 c |r| − c²) beyond it.
/// `slope` is dr̃/dr.
double heldBack(double r, double limit, double& slope) {
  const double size = std::abs(r);
  slope = 1.0;
  if (size <= limit) return r;
  const double root = std::sqrt(2.0 * limit * size - limit * limit);
  slope = limit / root;
  return std::copysign(root, r);
}

class FileCost final : public ceres::CostFunction {
 public:
  FileCost(const DriveFit& fit, std::size_t file) : fit_(fit), file_(file) {
    set_num_residuals(static_cast<int>(fit.residualCount(file)));
    *mutable_parameter_block_sizes() = {kDriveQuantities, 1};
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    DriveFit::Residuals found;
    fit_.evaluate(file_, x[0], *x[1], jacobians != nullptr, found);
    if (!found.value.allFinite()) return false;
    VectorXd::Map(residuals, num_residuals()) = found.value;
    if (!jacobians) return true;
    if (jacobians[0]) std::copy(found.by_log.data(), found.by_log.data() + found.by_log.size(), jacobians[0]);
    if (jacobians[1]) VectorXd::Map(jacobians[1], num_residuals()) = found.by_offset;
    return true;
  }

 private:
  const DriveFit& fit_;
  std::size_t file_;
};

/// The prior as residuals x / σ.
class PriorCost final : public ceres::SizedCostFunction<kDriveQuantities, kDriveQuantities> {
 public:
  explicit PriorCost(const DriveParameters& parameters) : parameters_(parameters) {}
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    for (int i = 0; i < kDriveQuantities; ++i) residuals[i] = x[0][i] / parameters_[i].prior_sigma;
    if (!jacobians || !jacobians[0]) return true;
    std::fill_n(jacobians[0], kDriveQuantities * kDriveQuantities, 0.0);
    for (int i = 0; i < kDriveQuantities; ++i)
      jacobians[0][i * (kDriveQuantities + 1)] = 1.0 / parameters_[i].prior_sigma;
    return true;
  }

 private:
  const DriveParameters& parameters_;
};

class DriveWatch final : public ceres::IterationCallback {
 public:
  explicit DriveWatch(base::Progress* progress) : progress_(progress) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (!progress_) return ceres::SOLVER_CONTINUE;
    progress_->report(1.0 - 1.0 / (1.0 + 0.1 * summary.iteration), "identification of a drive");
    return progress_->cancelled() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  base::Progress* progress_;
};

}  // namespace

DriveFit::DriveFit(const std::vector<DriveRecording>& recordings, const DriveParameters& parameters,
                   const DriveOptions& options)
    : offsets(options.offsets == OffsetRule::kShared ? 1 : recordings.size(), 0.0),
      recordings_(recordings),
      parameters_(parameters),
      options_(options),
      torque_sign_(identification::torqueSign(recordings)) {
  for (const DriveRecording& recording : recordings) {
    Eigen::Index count = 0;
    for (std::size_t k = 0; k < recording.size(); ++k)
      if (counts(recording, k))
        count += (std::isnan(recording.q[k]) ? 0 : 1) + (std::isnan(recording.tau_m[k]) ? 0 : 1);
    counts_.push_back(count);
  }
  start();
}

bool DriveFit::counts(const DriveRecording& recording, std::size_t row) const {
  return recording.t[row] - recording.t.front() >= DriveOptions::kSkip;
}

int DriveFit::observations() const {
  Eigen::Index sum = 0;
  for (const Eigen::Index count : counts_) sum += count;
  return static_cast<int>(sum);
}

void DriveFit::evaluate(std::size_t file, const double* logs_now, double offset, bool derivatives,
                        Residuals& out) const {
  const DriveRecording& recording = recordings_[file];
  const Eigen::Index count = counts_[file];
  out.t.clear();
  out.value.resize(count);
  out.by_log.setZero(derivatives ? count : 0, kDriveQuantities);
  out.by_offset.setZero(count);
  const auto fill = [&](const auto& prediction) {
    const auto add = [&](std::size_t k, double measured, const auto& predicted, double noise,
                         double by_offset) {
      const auto row = static_cast<Eigen::Index>(out.t.size());
      double slope = 1.0;
      out.value(row) = heldBack((measured - drive::valueOf(predicted)) / noise, options_.huber, slope);
      if constexpr (!std::is_same_v<std::decay_t<decltype(predicted)>, double>)
        out.by_log.row(row) = -slope / noise * predicted.v.transpose();
      out.by_offset(row) = by_offset * slope / noise;
      out.t.push_back(recording.t[k]);
    };
    for (std::size_t k = 0; k < recording.size(); ++k) {
      if (!counts(recording, k)) continue;
      if (!std::isnan(recording.q[k])) add(k, recording.q[k] - offset, prediction.q[k], angle_noise_, -1.0);
      if (!std::isnan(recording.tau_m[k]))
        add(k, torque_sign_ * recording.tau_m[k], prediction.tau_m[k], torque_noise_, 0.0);
    }
  };
  if (derivatives) {
    std::array<Jet, kDriveQuantities> x;
    for (int i = 0; i < kDriveQuantities; ++i) x[static_cast<std::size_t>(i)] = Jet(logs_now[i], i);
    DrivePrediction<Jet> prediction;
    predict(parameters_.law(x.data()), recording, prediction);
    fill(prediction);
  } else {
    DrivePrediction<double> prediction;
    predict(parameters_.law(logs_now), recording, prediction);
    fill(prediction);
  }
}

/// Sets initial offsets from the nominal robot: without them every residual would be an outlier.
void DriveFit::start() {
  std::vector<std::vector<double>> rests(offsets.size());
  const DriveLaw<double> law = parameters_.law<double>(logs.data());
  DrivePrediction<double> prediction;
  for (std::size_t file = 0; file < recordings_.size(); ++file) {
    const DriveRecording& recording = recordings_[file];
    predict(law, recording, prediction);
    for (std::size_t k = 0; k < recording.size(); ++k)
      if (counts(recording, k) && !std::isnan(recording.q[k]))
        rests[offsetOf(file)].push_back(recording.q[k] - prediction.q[k]);
  }
  for (std::size_t i = 0; i < offsets.size(); ++i)
    if (!rests[i].empty()) offsets[i] = stats::median(rests[i]);
  measureNoise();
}

/// Measures the noise: robust standard deviations of the residuals. Returns true when they have changed.
bool DriveFit::measureNoise() {
  constexpr double kSigmaOfMedian = 1.4826, kSettled = 0.02, kLeast = 1e-9;
  std::vector<double> angles, torques;
  DrivePrediction<double> prediction;
  const DriveLaw<double> law = parameters_.law<double>(logs.data());
  for (std::size_t file = 0; file < recordings_.size(); ++file) {
    const DriveRecording& recording = recordings_[file];
    predict(law, recording, prediction);
    for (std::size_t k = 0; k < recording.size(); ++k) {
      if (!counts(recording, k)) continue;
      const double angle = std::abs(recording.q[k] - offsets[offsetOf(file)] - prediction.q[k]);
      const double torque = std::abs(torque_sign_ * recording.tau_m[k] - prediction.tau_m[k]);
      if (!std::isnan(angle)) angles.push_back(angle);
      if (!std::isnan(torque)) torques.push_back(torque);
    }
  }
  const double angle_before = angle_noise_, torque_before = torque_noise_;
  if (!angles.empty()) angle_noise_ = std::max(kLeast, kSigmaOfMedian * stats::median(angles));
  torque_noise_ = torques.empty() ? 0.0 : std::max(kLeast, kSigmaOfMedian * stats::median(torques));
  return std::abs(angle_noise_ - angle_before) > kSettled * angle_before ||
         std::abs(torque_noise_ - torque_before) > kSettled * torque_before;
}

BatchEnd DriveFit::solve(const Held& held, base::Progress* progress) {
  constexpr int kMostRounds = 6;
  BatchEnd end = BatchEnd::kFailed;
  for (int round = 0; round < kMostRounds; ++round) {
    ceres::Problem problem;
    for (std::size_t file = 0; file < recordings_.size(); ++file)
      if (counts_[file] > 0)
        problem.AddResidualBlock(new FileCost(*this, file), nullptr, logs.data(), &offsets[offsetOf(file)]);
    problem.AddResidualBlock(new PriorCost(parameters_), nullptr, logs.data());
    std::vector<int> constant;
    for (int i = 0; i < kDriveQuantities; ++i) {
      problem.SetParameterLowerBound(logs.data(), i, -parameters_[i].bound);
      problem.SetParameterUpperBound(logs.data(), i, parameters_[i].bound);
      if (held[static_cast<std::size_t>(i)]) constant.push_back(i);
    }
    if (static_cast<int>(constant.size()) == kDriveQuantities)
      problem.SetParameterBlockConstant(logs.data());
    else if (!constant.empty())
      problem.SetManifold(logs.data(), new ceres::SubsetManifold(kDriveQuantities, constant));
    DriveWatch watch(progress);
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = kMostDriveIterations;
    solver.function_tolerance = 1e-8;
    solver.logging_type = ceres::SILENT;
    solver.callbacks.push_back(&watch);
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    iterations_ += static_cast<int>(summary.iterations.size());
    end = endOf(summary, progress);
    if (end == BatchEnd::kCancelled || end == BatchEnd::kFailed || !measureNoise()) break;
  }
  return end;
}

double DriveFit::outliers() const {
  Eigen::Index beyond = 0;
  Residuals residuals;
  for (std::size_t file = 0; file < recordings_.size(); ++file) {
    evaluate(file, logs.data(), offsets[offsetOf(file)], false, residuals);
    beyond += (residuals.value.array().abs() > options_.huber).count();
  }
  return static_cast<double>(beyond) / std::max(1, observations());
}

MatrixXd DriveFit::covariance(const Held& held) const {
  std::vector<int> free;
  for (int i = 0; i < kDriveQuantities; ++i)
    if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
  const auto parameters = static_cast<Eigen::Index>(free.size());
  const Eigen::Index n = parameters + static_cast<Eigen::Index>(offsets.size());
  MatrixXd information = MatrixXd::Zero(n, n), meat = information;
  for (Eigen::Index i = 0; i < parameters; ++i)
    information(i, i) = std::pow(parameters_[free[static_cast<std::size_t>(i)]].prior_sigma, -2);
  meat = information;
  const bool whole = recordings_.size() > free.size();
  int blocks = 0;
  Residuals residuals;
  for (std::size_t file = 0; file < recordings_.size(); ++file) {
    evaluate(file, logs.data(), offsets[offsetOf(file)], true, residuals);
    VectorXd gradient = VectorXd::Zero(n), row(n);
    const auto close = [&] {
      meat += gradient * gradient.transpose();
      gradient.setZero();
      ++blocks;
    };
    double start = residuals.t.empty() ? 0.0 : residuals.t.front();
    for (Eigen::Index k = 0; k < residuals.value.size(); ++k) {
      const double t = residuals.t[static_cast<std::size_t>(k)];
      if (!whole && t - start >= kCorrelationBlock) {
        close();
        start = t;
      }
      row.setZero();
      for (Eigen::Index i = 0; i < parameters; ++i)
        row(i) = residuals.by_log(k, free[static_cast<std::size_t>(i)]);
      row(parameters + static_cast<Eigen::Index>(offsetOf(file))) = residuals.by_offset(k);
      information.noalias() += row * row.transpose();
      gradient += residuals.value(k) * row;
    }
    close();
  }
  const MatrixXd plain = information.inverse();
  const double few =
      static_cast<double>(blocks) / std::max<double>(1.0, static_cast<double>(blocks - parameters));
  const MatrixXd sandwich = few * plain * meat * plain;
  VectorXd grow(n);
  for (Eigen::Index i = 0; i < n; ++i)
    grow(i) = std::sqrt(std::max(1.0, plain(i, i) / std::max(1e-300, sandwich(i, i))));
  return grow.asDiagonal() * sandwich * grow.asDiagonal();
}

}  // namespace capstan::identification
