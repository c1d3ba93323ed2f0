#include "core/diagnosis/poses/pose_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLittle = 1e-4;  // of a scale, for derivatives
constexpr int kIterations = 20, kAttempts = 6;
constexpr double kRidge = 1e-9;  // keeps what has no influence finite
constexpr double kDone = 1e-6;   // of the cost, by which a step must lower it to go on
constexpr double kMadToSigma = 1.4826;
constexpr double kLeastSpread = 1e-9;  // [m]

struct Bounds {
  VectorXd scale, low, high;
};

Bounds boundsOf(const std::vector<PoseHypothesis>& effects) {
  std::vector<double> scale, low, high;
  for (const PoseHypothesis& effect : effects)
    for (const robot::EffectParameter& parameter : *effect.parameters) {
      scale.push_back(effect.scale);
      low.push_back(parameter.low);
      high.push_back(parameter.high);
    }
  const auto vector = [](const std::vector<double>& v) {
    return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(v.size())));
  };
  return {vector(scale), vector(low), vector(high)};
}

Eigen::Vector3d spreadOf(const Matrix3Xd& e) {
  Eigen::Vector3d spread;
  std::vector<double> size(static_cast<std::size_t>(e.cols()));
  for (int axis = 0; axis < 3; ++axis) {
    for (Index i = 0; i < e.cols(); ++i) size[static_cast<std::size_t>(i)] = std::abs(e(axis, i));
    const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
    std::nth_element(size.begin(), middle, size.end());
    spread[axis] = std::max(kMadToSigma * *middle, kLeastSpread);
  }
  return spread;
}

double costOf(const Matrix3Xd& e, const Eigen::Vector3d& spread) {
  double cost = 0.0;
  for (Index i = 0; i < e.cols(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double z = std::abs(e(axis, i)) / spread[axis];
      cost += z <= kHuber ? 0.5 * z * z : kHuber * (z - 0.5 * kHuber);
    }
  return cost;
}

VectorXd weightsOf(const Matrix3Xd& e, const Eigen::Vector3d& spread) {
  VectorXd weight(e.size());
  for (Index i = 0; i < e.cols(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double z = std::abs(e(axis, i)) / spread[axis];
      weight[3 * i + axis] = std::min(1.0, kHuber / std::max(z, 1e-12)) / (spread[axis] * spread[axis]);
    }
  return weight;
}

/// Derivatives of predictions by value / scale; away from an upper bound.
MatrixXd jacobianOf(const PoseData& data, const std::vector<PoseHypothesis>& effects, const VectorXd& value,
                    const Matrix3Xd& e, const Bounds& bounds) {
  MatrixXd jacobian(e.size(), value.size());
  for (Index k = 0; k < value.size(); ++k) {
    VectorXd moved = value;
    const double step = moved[k] + kLittle * bounds.scale[k] > bounds.high[k] ? -kLittle : kLittle;
    moved[k] += step * bounds.scale[k];
    const Matrix3Xd other = residualOf(data, numbersOf(effects, moved));
    jacobian.col(k) = (e - other).reshaped() / step;
  }
  return jacobian;
}

/// At a bound, or without any influence: not to be moved by a step.
std::vector<Index> freeOf(const PoseFit& fit, const Bounds& bounds) {
  std::vector<Index> free;
  for (Index k = 0; k < fit.value.size(); ++k)
    if (fit.value[k] > bounds.low[k] && fit.value[k] < bounds.high[k] &&
        fit.jacobian.col(k).squaredNorm() > 0.0)
      free.push_back(k);
  return free;
}

MatrixXd normalOf(const PoseFit& fit, Index first, Index count, const std::vector<Index>& free) {
  const MatrixXd rows = fit.jacobian.middleRows(3 * first, 3 * count)(Eigen::all, free);
  return rows.transpose() * fit.weight.segment(3 * first, 3 * count).asDiagonal() * rows;
}

VectorXd scoreOf(const PoseFit& fit, Index first, Index count, const std::vector<Index>& free) {
  const VectorXd e = fit.e.middleCols(first, count).reshaped();
  const MatrixXd rows = fit.jacobian.middleRows(3 * first, 3 * count)(Eigen::all, free);
  return rows.transpose() * fit.weight.segment(3 * first, 3 * count).cwiseProduct(e);
}

}  // namespace

PoseData::PoseData(std::vector<PoseMotion> motions) : motions_(std::move(motions)), first_{0} {
  for (const PoseMotion& motion : motions_) first_.push_back(first_.back() + motion.observed.cols());
}

Index PoseFit::placeOf(std::string_view effect) const {
  Index place = 0;
  for (const PoseHypothesis& one : effects) {
    if (one.name == effect) return place;
    place += static_cast<Index>(one.size());
  }
  return -1;
}

std::vector<double> PoseFit::valuesOf(std::string_view effect) const {
  for (const PoseHypothesis& one : effects)
    if (one.name == effect) {
      const double* begin = value.data() + placeOf(effect);
      return {begin, begin + one.size()};
    }
  return {};
}

PoseNumbers numbersOf(const std::vector<PoseHypothesis>& effects, const VectorXd& value) {
  PoseNumbers numbers;
  std::size_t at = 0;
  for (const PoseHypothesis& effect : effects) {
    effect.set(numbers, {value.data() + at, effect.size()});
    at += effect.size();
  }
  return numbers;
}

Matrix3Xd residualOf(const PoseData& data, const PoseNumbers& numbers) {
  Matrix3Xd e(3, data.observations());
  for (Index k = 0; k < data.blocks(); ++k) {
    const PoseMotion& motion = data.motions()[static_cast<std::size_t>(k)];
    e.middleCols(data.first(k), data.count(k)) = motion.observed - seenBy(numbers, motion);
  }
  return e;
}

namespace {

/// One damped step of the fit: by which share it lowered the cost, 0 where no step does.
double improve(const PoseData& data, PoseFit& fit, const Bounds& bounds, double& damping) {
  const Eigen::Vector3d spread = spreadOf(fit.e);
  const double cost = costOf(fit.e, spread);
  fit.weight = weightsOf(fit.e, spread);
  fit.jacobian = jacobianOf(data, fit.effects, fit.value, fit.e, bounds);
  std::vector<Index> all(static_cast<std::size_t>(fit.value.size()));
  std::iota(all.begin(), all.end(), Index{0});
  const MatrixXd normal = normalOf(fit, 0, data.observations(), all);
  const VectorXd score = scoreOf(fit, 0, data.observations(), all);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    MatrixXd damped = normal;
    damped.diagonal() += damping * normal.diagonal() + VectorXd::Constant(normal.rows(), kRidge);
    const VectorXd step = damped.ldlt().solve(score).cwiseProduct(bounds.scale);
    const VectorXd moved = (fit.value + step).cwiseMax(bounds.low).cwiseMin(bounds.high);
    Matrix3Xd e = residualOf(data, numbersOf(fit.effects, moved));
    const double there = costOf(e, spread);
    if (there < cost) {
      fit.value = moved;
      fit.e = std::move(e);
      damping = std::max(damping / 10.0, 1e-9);
      return 1.0 - there / cost;
    }
    damping *= 10.0;
  }
  return 0.0;
}

}  // namespace

PoseFit fitPoses(const PoseData& data, std::vector<PoseHypothesis> effects, VectorXd value) {
  PoseFit fit{std::move(effects), std::move(value), {}, {}, {}};
  const Bounds bounds = boundsOf(fit.effects);
  fit.e = residualOf(data, numbersOf(fit.effects, fit.value));
  double damping = 1e-4;
  for (int iteration = 0; iteration < kIterations && fit.value.size() > 0; ++iteration)
    if (improve(data, fit, bounds, damping) < kDone) break;
  fit.weight = weightsOf(fit.e, spreadOf(fit.e));
  fit.jacobian = jacobianOf(data, fit.effects, fit.value, fit.e, bounds);
  return fit;
}

PoseFit with(const PoseData& data, const PoseFit& fit, const PoseHypothesis& effect) {
  std::vector<PoseHypothesis> effects = fit.effects;
  effects.push_back(effect);
  const auto size = static_cast<Index>(effect.size());
  VectorXd value(fit.value.size() + size);
  value << fit.value, VectorXd::Constant(size, effect.start);
  return fitPoses(data, std::move(effects), std::move(value));
}

PoseFit without(const PoseData& data, const PoseFit& fit, std::string_view effect) {
  std::vector<PoseHypothesis> effects;
  std::vector<double> value;
  for (const PoseHypothesis& one : fit.effects) {
    if (one.name == effect) continue;
    effects.push_back(one);
    for (const double number : fit.valuesOf(one.name)) value.push_back(number);
  }
  return fitPoses(data, std::move(effects),
                  Eigen::Map<const VectorXd>(value.data(), static_cast<Index>(value.size())));
}

Matrix3Xd heldOut(const PoseData& data, const PoseFit& fit) {
  if (fit.value.size() == 0) return fit.e;
  const Bounds bounds = boundsOf(fit.effects);
  const std::vector<Index> free = freeOf(fit, bounds);
  const MatrixXd normal = normalOf(fit, 0, data.observations(), free);
  const VectorXd score = scoreOf(fit, 0, data.observations(), free);
  Matrix3Xd e(3, data.observations());
  for (Index fold = 0; fold < std::min<Index>(kFolds, data.blocks()); ++fold) {
    MatrixXd others = normal;
    VectorXd rest = score;
    for (Index k = fold; k < data.blocks(); k += kFolds) {
      others -= normalOf(fit, data.first(k), data.count(k), free);
      rest -= scoreOf(fit, data.first(k), data.count(k), free);
    }
    const VectorXd step = others.ldlt().solve(rest).cwiseMax(-kLongestWay).cwiseMin(kLongestWay);
    VectorXd value = fit.value;
    for (std::size_t i = 0; i < free.size(); ++i)
      value[free[i]] += step[static_cast<Index>(i)] * bounds.scale[free[i]];
    const PoseNumbers numbers = numbersOf(fit.effects, value.cwiseMax(bounds.low).cwiseMin(bounds.high));
    for (Index k = fold; k < data.blocks(); k += kFolds) {
      const PoseMotion& motion = data.motions()[static_cast<std::size_t>(k)];
      e.middleCols(data.first(k), data.count(k)) = motion.observed - seenBy(numbers, motion);
    }
  }
  return e;
}

MatrixXd covarianceOf(const PoseData& data, const PoseFit& fit) {
  const Bounds bounds = boundsOf(fit.effects);
  const std::vector<Index> free = freeOf(fit, bounds);
  const auto p = static_cast<Index>(free.size());
  const MatrixXd inverse = normalOf(fit, 0, data.observations(), free).ldlt().solve(MatrixXd::Identity(p, p));
  MatrixXd meat = MatrixXd::Zero(p, p);
  for (Index k = 0; k < data.blocks(); ++k) {
    const VectorXd score = scoreOf(fit, data.first(k), data.count(k), free);
    meat += score * score.transpose();
  }
  const double blocks = static_cast<double>(data.blocks());
  const MatrixXd sandwich =
      inverse * meat * inverse * (blocks / std::max(blocks - static_cast<double>(p), 1.0));
  MatrixXd covariance = MatrixXd::Zero(fit.value.size(), fit.value.size());
  for (Index i = 0; i < p; ++i)
    for (Index j = 0; j < p; ++j)
      covariance(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]) =
          sandwich(i, j) * bounds.scale[free[static_cast<std::size_t>(i)]] *
          bounds.scale[free[static_cast<std::size_t>(j)]];
  return covariance;
}

BlockSquares squaresOf(const PoseData& data, const Matrix3Xd& e) {
  BlockSquares squares{MatrixXd::Zero(3, data.blocks()), MatrixXd::Zero(3, data.blocks()), VectorXd::Ones(3)};
  VectorXd together = VectorXd::Zero(3);
  for (Index k = 0; k < data.blocks(); ++k) {
    const auto block = e.middleCols(data.first(k), data.count(k));
    squares.sum.col(k) = block.rowwise().squaredNorm();
    squares.count.col(k).setConstant(static_cast<double>(data.count(k)));
    together += block.rowwise().sum().cwiseAbs2();
  }
  for (Index axis = 0; axis < 3; ++axis) {
    const double total = squares.sum.row(axis).sum(), n = squares.count.row(axis).sum();
    if (total > 0.0)
      squares.inflation[axis] = std::clamp(together[axis] / total, 1.0, std::max(1.0, n / 8.0));
  }
  return squares;
}

}  // namespace capstan::diagnosis
