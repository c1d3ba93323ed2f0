#include "core/identification/parameter_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/math/cholesky.h"
#include "core/math/instruction_set.h"

namespace capstan::identification {
namespace {

constexpr int kLanes = tracking::kCableArmLanes;
const double kSpread = std::sqrt(3.0);
constexpr double kRateTolerance = 0.05;  // change of a logarithm after which the rate is computed again

}  // namespace

ParameterFilter::ParameterFilter(const ParameterSet& set, const robot::ArmKinematics& arm,
                                 const CameraPoseOptions& pose, const Eigen::Vector3d& centre)
    : set_(set),
      arm_(arm),
      kernel_(&tracking::cableArmKernel(math::bestInstructionSet())),
      constants_(set.constants(ParameterSet::Logs::Zero(set.size()))),
      centre_(centre),
      n_(set.size()) {
  for (int i = 0; i < n_; ++i) scale_(i) = set[i].prior_sigma;
  scale_.segment<CameraPose::kSize>(n_) = pose.sigmas();
  filter_.reset(Unknowns::Zero(), estimation::Lower<kUnknowns>::Identity());
  for (auto& cable : cables_)
    for (int joint = 0; joint < 3; ++joint)
      for (int lane = 0; lane < kLanes; ++lane) {
        cable.link_radius[joint][lane] = constants_.link_radius[joint];
        cable.stiffness[joint][lane] = constants_.stiffness[joint];
        cable.damping[joint][lane] = constants_.damping[joint];
        cable.coulomb[joint][lane] = constants_.coulomb[joint];
      }
}

CameraPose ParameterFilter::poseOf(const Unknowns& x) const {
  return cameraPoseOf(scale_.cwiseProduct(x).segment<CameraPose::kSize>(n_));
}

/// Sigma point `index`: 0 is the centre; then + and − along the column of each cable parameter.
ParameterFilter::Unknowns ParameterFilter::point(int index) const {
  if (index == 0) return filter_.mean();
  const int column = (index - 1) / 2;
  const double side = index % 2 == 1 ? kSpread : -kSpread;
  return filter_.mean() + side * filter_.squareRoot().col(column);
}

void ParameterFilter::draw(const State& x) {
  const ParameterSet::Logs centre = logs();
  for (int index = 0; index < points(); ++index) {
    const auto batch = static_cast<std::size_t>(index / kLanes);
    const int lane = index % kLanes;
    const Unknowns unknowns = scale_.cwiseProduct(point(index));
    for (int i = 0; i < n_; ++i) {
      const Parameter& parameter = set_[i];
      const double value = set_.value(i, std::clamp(unknowns(i), -parameter.bound, parameter.bound));
      auto& cable = cables_[batch];
      fieldOf(cable, parameter.quantity)[parameter.joint][lane] = value;
    }
    states_[batch].col(lane) = x + sensitivity_.leftCols(n_) * (unknowns.head(n_) - centre);
  }
  for (int index = points(); index < kBatches * kLanes; ++index)  // unused lanes get a valid state
    states_[static_cast<std::size_t>(index / kLanes)].col(index % kLanes) = x;
}

/// Upper bound on the eigenvalues over all sigma points [1/s]: the rate with every parameter at its upper
/// sigma point.
double ParameterFilter::fastestRate() {
  ParameterSet::Logs high = logs();
  for (int i = 0; i < n_; ++i) {
    const double sigma = scale_(i) * filter_.squareRoot().row(i).norm();
    high(i) = std::clamp(high(i) + kSpread * sigma, -set_[i].bound, set_[i].bound);
  }
  if (rate_ > 0.0 && (high - rate_at_).maxCoeff() <= 0.0 && (rate_at_ - high).maxCoeff() < kRateTolerance)
    return rate_;
  rate_at_ = high.array() + 0.5 * kRateTolerance;
  rate_ = set_.rate(rate_at_);
  return rate_;
}

void ParameterFilter::propagate(const State& x, const MotorInterval& interval) {
  draw(x);
  const double rate = fastestRate();
  for (int batch = 0; batch * kLanes < points(); ++batch) {
    const auto b = static_cast<std::size_t>(batch);
    for (const MotorInterval::Step& step : interval.steps) {
      const int steps = std::max(1, static_cast<int>(std::ceil(0.5 * rate * step.dt)));
      kernel_->propagateVaried(constants_, cables_[b], step.drive, step.dt, steps, states_[b].data());
    }
  }
  // Φ = D S⁻¹ with D the central differences along the columns of S.
  Sensitivity difference = Sensitivity::Zero();
  for (int i = 0; i < n_; ++i) {
    const int plus = 1 + 2 * i, minus = plus + 1;
    difference.col(i) = (states_[static_cast<std::size_t>(plus / kLanes)].col(plus % kLanes) -
                         states_[static_cast<std::size_t>(minus / kLanes)].col(minus % kLanes)) /
                        (2.0 * kSpread);
  }
  const Eigen::MatrixXd root = scale_.head(n_).asDiagonal() * filter_.squareRoot().topLeftCorner(n_, n_);
  sensitivity_.setZero();
  sensitivity_.leftCols(n_) =
      root.triangularView<Eigen::Lower>().transpose().solve(difference.leftCols(n_).transpose()).transpose();
}

Eigen::Vector3d ParameterFilter::observe(int propagated, const CameraPose& pose) const {
  const State x = states_[static_cast<std::size_t>(propagated / kLanes)].col(propagated % kLanes);
  const Eigen::Vector3d q(x(0), x(2), x(4)), dq(x(1), x(3), x(5));
  return pose.seen(arm_.tip(q - pose.delay * dq), centre_);
}

ParameterFilter::Innovation ParameterFilter::update(const CameraObservation& seen,
                                                    const Eigen::Matrix3d& state_noise, double huber) {
  const int all = n_ + CameraPose::kSize;
  const Eigen::Vector3d centre = observe(0, pose());
  Eigen::Matrix<double, 3, kUnknowns> difference = Eigen::Matrix<double, 3, kUnknowns>::Zero();
  Eigen::Vector3d bend = Eigen::Vector3d::Zero();
  for (int i = 0; i < all; ++i) {
    const bool cable = i < n_;
    const Unknowns step = kSpread * filter_.squareRoot().col(i);
    const Eigen::Vector3d plus = observe(cable ? 1 + 2 * i : 0, poseOf(filter_.mean() + step));
    const Eigen::Vector3d minus = observe(cable ? 2 + 2 * i : 0, poseOf(filter_.mean() - step));
    difference.col(i) = (plus - minus) / (2.0 * kSpread);
    bend += (plus + minus - 2.0 * centre) / (2.0 * kSpread * kSpread);
  }
  estimation::LinearMeasurement<kUnknowns, 3> measurement;
  measurement.h = filter_.squareRoot()
                      .transpose()
                      .triangularView<Eigen::Upper>()
                      .solve(difference.transpose())
                      .transpose();
  Innovation out;
  out.by_unknown = measurement.h;
  out.value = seen.tip - (centre + bend);
  out.noise_covariance = seen.tip_covariance + state_noise;
  out.innovation_covariance = out.noise_covariance + difference * difference.transpose();
  out.nis = out.value.dot(out.innovation_covariance.llt().solve(out.value));
  out.weight = out.nis > huber * huber ? huber / std::sqrt(out.nis) : 1.0;
  const estimation::Lower<3> root = (out.noise_covariance / out.weight).llt().matrixL().toDenseMatrix();
  const Eigen::Vector3d y = out.value + measurement.h * filter_.mean();
  filter_.update(measurement, y, root);
  return out;
}

void ParameterFilter::forget(double memory, double dt) {
  estimation::Lower<kUnknowns> root = filter_.squareRoot();
  for (int i = 0; i < n_ + CameraPose::kSize; ++i) {
    const double variance = root.row(i).squaredNorm();
    Unknowns column = Unknowns::Zero();
    column(i) = std::sqrt(std::max(0.0, variance * (1.0 - variance) * std::min(1.0, dt / memory)));
    math::rankOneUpdate(root, column);
  }
  filter_.reset(filter_.mean(), root);
}

}  // namespace capstan::identification
