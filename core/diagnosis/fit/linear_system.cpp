#include "core/diagnosis/fit/linear_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace capstan::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kDifference = 1e-3;  // step of u for finite differences

/// Rotation of the motor per rotation of the joint.
double ratioOf(const robot::ChainModel& model, int j) {
  return model.numbers.joints[j].link_radius / model.numbers.joints[j].lever;
}

/// Natural frequency of a compliant motor on its cable, with the joint held [rad/s].
double motorRate(const robot::ChainModel& model, int j) {
  const robot::JointNumbers<double>& p = model.numbers.joints[j];
  return p.lever / std::sqrt(p.compliance * p.motor_inertia);
}

/// Steps of the initial states for finite differences: 1e-5 of the range for joint positions, 1e-5 of the
/// largest for speeds, and the same through the gear ratio for compliant motors; 0 for states that the robot
/// does not have.
VectorXd initialDifferences(const robot::ChainModel& model) {
  const int n = model.shape.joints;
  VectorXd h = VectorXd::Zero(4 * n);
  for (int j = 0; j < n; ++j) {
    h[j] = 1e-5 / model.shape.inverse_half_range[j];
    h[n + j] = 1e-5 * model.shape.fastest[j];
    if (!(model.shape.laws[j] & robot::kLawCompliance)) continue;
    h[2 * n + j] = ratioOf(model, j) * h[j];
    h[3 * n + j] = ratioOf(model, j) * h[n + j];
  }
  return h;
}

InitialStates shifted(InitialStates initial, Index state, double h) {
  for (MatrixXd& x : initial) x.row(state).array() += h;
  return initial;
}

/// Derivatives by the encoder zeros: 1 in column j for readings of joint j's encoder.
MatrixXd encoderZeros(const FitData& data, int joints) {
  MatrixXd zeros = MatrixXd::Zero(data.size(), joints);
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    const ComparedChannel& channel = data.channels()[static_cast<std::size_t>(data.channel()[i])];
    if (channel.joint > 0) zeros(static_cast<Index>(i), channel.joint - 1) = 1.0;
  }
  return zeros;
}

/// Index of the parameter in another model that has it with the same scale; −1: none.
int placeIn(const FitModel& other, const FitParameter& parameter) {
  for (int k = 0; k < other.size(); ++k) {
    const FitParameter& p = other.parameters()[static_cast<std::size_t>(k)];
    if (p.name == parameter.name && p.joint == parameter.joint && p.scale == parameter.scale &&
        p.logarithmic == parameter.logarithmic)
      return k;
  }
  return -1;
}

/// u with parameter k moved by kDifference, away from a bound.
VectorXd moved(const FitModel& model, const VectorXd& u, int k) {
  VectorXd to = u;
  to[k] += kDifference;
  if ((model.clipped(to) - to).cwiseAbs().maxCoeff() > 1e-12) to[k] -= 2.0 * kDifference;
  return to;
}

}  // namespace

VectorXd nuisancePrecision(const FitData& data, const robot::ChainModel& model) {
  const int n = model.shape.joints;
  if (!data.rigid()) return VectorXd::Zero(n);
  constexpr double kWholeSlope = 500.0;  // σ of an initial speed, over the encoder's noise [1/s]
  constexpr double kMotorSwing = 0.1;    // σ of a compliant motor's speed, over that of the joint's, geared
  const ChainSimulation& first = data.simulation(0);
  const bool whole = first.windows().size() == first.evidence().segments.size();
  VectorXd precision = VectorXd::Ones(4 * n);  // 1 for states that do not exist
  for (int j = 0; j < n; ++j) {
    double noise = 0.0;
    for (const ComparedChannel& channel : data.channels())
      if (channel.joint == j + 1) noise = std::max(noise, channel.noise);
    const double position = noise > 0.0 ? 4.0 * noise : 0.1 / model.shape.inverse_half_range[j];
    const double most = 0.1 * model.shape.fastest[j] / 20.0;
    const double speed = whole && noise > 0.0 ? std::min(kWholeSlope * noise, most) : most;
    precision[j] = 1.0 / (position * position);
    precision[n + j] = 1.0 / (speed * speed);
    if (!(model.shape.laws[j] & robot::kLawCompliance)) continue;
    const double swing = kMotorSwing * ratioOf(model, j) * most, arc = swing / motorRate(model, j);
    precision[2 * n + j] = 1.0 / (arc * arc);
    precision[3 * n + j] = 1.0 / (swing * swing);
  }
  return precision;
}

std::vector<MatrixXd> takeOffNuisances(const FitData& data, const MatrixXd& nuisance,
                                       const VectorXd& precision, const VectorXd& weights,
                                       Eigen::Ref<MatrixXd> x) {
  std::vector<MatrixXd> coefficients;
  if (nuisance.cols() == 0) return coefficients;
  for (const auto& [begin, end] : data.segments()) {
    const MatrixXd part = nuisance.middleRows(begin, end - begin);
    const MatrixXd heavy = weights.segment(begin, end - begin).cwiseAbs2().asDiagonal() * part;
    MatrixXd normal = heavy.transpose() * part;
    normal.diagonal() += precision;
    normal.diagonal() *= 1.0 + 1e-12;
    coefficients.push_back(normal.ldlt().solve(heavy.transpose() * x.middleRows(begin, end - begin)));
    x.middleRows(begin, end - begin) -= part * coefficients.back();
  }
  return coefficients;
}

double reached(const FitData& data, const FitModel& model, const VectorXd& u, const VectorXd& simulated,
               const VectorXd& removed, const Weighting& weighting) {
  return objectiveOf(model, u, data.rigid() ? simulated : removed, weighting);
}

namespace {

/// Derivatives by forward differences. The first robot is that of the point, then one robot per parameter
/// that is simulated, then one robot per initial state of rigid drives.
class ForwardDifferences {
 public:
  ForwardDifferences(const FitData& data, const LinearisationPoint& point)
      : data_(data), point_(point), jacobian_(data.size(), point.model->size()) {
    const FitModel& model = *point.model;
    add(model.chain(point.u), point.initial);
    for (int k = 0; k < model.size(); ++k) {
      const FitParameter& parameter = model.parameters()[static_cast<std::size_t>(k)];
      const int place = point.known ? placeIn(point.known->model, parameter) : -1;
      if (place >= 0) {
        jacobian_.col(k) = point.known->jacobian.col(place);
        continue;
      }
      const VectorXd to = moved(model, point.u, k);
      steps_.emplace_back(k, to[k] - point.u[k]);
      add(model.chain(to), point.initial);
    }
    state_steps_ = initialDifferences(robots_.front());
    for (Index s = 0; data.rigid() && s < state_steps_.size(); ++s)
      if (state_steps_[s] != 0.0) add(robots_.front(), shifted(point.initial, s, state_steps_[s]));
  }

  const std::vector<robot::ChainModel>& robots() const { return robots_; }
  const std::vector<InitialStates>& starts() const { return starts_; }

  /// `readings`: one column per robot.
  System system(const Eigen::Ref<const MatrixXd>& readings) {
    for (std::size_t i = 0; i < steps_.size(); ++i)
      jacobian_.col(steps_[i].first) =
          (readings.col(static_cast<Index>(i) + 1) - readings.col(0)) / steps_[i].second;
    System system{{*point_.model, point_.u, point_.initial, data_.measured() - readings.col(0),
                   std::move(jacobian_), nuisances(readings)},
                  {},
                  {}};
    const Weighting& weighting = *point_.weighting;
    const VectorXd precision = nuisancePrecision(data_, robots_.front()), simulated = system.at.e;
    system.off_residual =
        takeOffNuisances(data_, system.at.nuisance, precision, weighting.weights, system.at.e);
    system.at.removed =
        takeOffNuisances(data_, system.at.nuisance, precision, weighting.weights, system.at.jacobian);
    system.at.objective = objectiveOf(*point_.model, point_.u, system.at.e, weighting);
    system.objective = reached(data_, *point_.model, point_.u, simulated, system.at.e, weighting);
    return system;
  }

 private:
  void add(const robot::ChainModel& robot, const InitialStates& start) {
    robots_.push_back(robot);
    starts_.push_back(start);
  }

  MatrixXd nuisances(const Eigen::Ref<const MatrixXd>& readings) const {
    if (!data_.rigid())
      return data_.zerosFree() ? encoderZeros(data_, robots_.front().shape.joints) : MatrixXd();
    MatrixXd nuisance = MatrixXd::Zero(data_.size(), state_steps_.size());
    auto column = static_cast<Index>(steps_.size()) + 1;
    for (Index s = 0; s < state_steps_.size(); ++s)
      if (state_steps_[s] != 0.0)
        nuisance.col(s) = (readings.col(column++) - readings.col(0)) / state_steps_[s];
    return nuisance;
  }

  const FitData& data_;
  const LinearisationPoint& point_;
  MatrixXd jacobian_;
  std::vector<std::pair<int, double>> steps_;  ///< parameters that are simulated, and their steps
  VectorXd state_steps_;  ///< of the initial states; 0: the robot does not have the state
  std::vector<robot::ChainModel> robots_;
  std::vector<InitialStates> starts_;
};

}  // namespace

std::vector<System> systemsAt(const FitData& data, const std::vector<LinearisationPoint>& points) {
  std::vector<ForwardDifferences> differences;
  std::vector<robot::ChainModel> robots;
  std::vector<InitialStates> starts;
  std::vector<std::size_t> family;
  for (const LinearisationPoint& point : points) {
    const ForwardDifferences& one = differences.emplace_back(data, point);
    family.insert(family.end(), one.robots().size(), differences.size());
    robots.insert(robots.end(), one.robots().begin(), one.robots().end());
    starts.insert(starts.end(), one.starts().begin(), one.starts().end());
  }
  const MatrixXd readings = data.simulate(robots, starts, family);
  std::vector<System> systems;
  Index first = 0;
  for (ForwardDifferences& one : differences) {
    const auto count = static_cast<Index>(one.robots().size());
    systems.push_back(one.system(readings.middleCols(first, count)));
    first += count;
  }
  return systems;
}

VectorXd priorPrecision(const FitModel& model) {
  VectorXd precision(model.size());
  for (int k = 0; k < model.size(); ++k) {
    const double prior = model.parameters()[static_cast<std::size_t>(k)].prior;
    precision[k] = 1.0 / (prior * prior);
  }
  return precision;
}

InitialStates following(const FitData& data, const Fit& at, const VectorXd& step) {
  InitialStates initial = at.initial;
  if (data.rigid())
    forSegments(data, [&](std::size_t r, Index w, std::size_t segment) {
      initial[r].col(w) -= at.removed[segment] * step;
    });
  return initial;
}

}  // namespace capstan::diagnosis
