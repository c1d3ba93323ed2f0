#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/fit/held_out.h"
#include "core/diagnosis/hypotheses/pose_hypotheses.h"

namespace capstan::diagnosis {

/// Motions of a fit. The observations of all motions are numbered in one sequence.
class PoseData {
 public:
  explicit PoseData(std::vector<PoseMotion> motions);

  const std::vector<PoseMotion>& motions() const { return motions_; }
  Eigen::Index observations() const { return first_.back(); }
  Eigen::Index blocks() const { return static_cast<Eigen::Index>(motions_.size()); }
  /// First observation of motion `k`; for k = blocks() the number of observations.
  Eigen::Index first(Eigen::Index k) const { return first_[static_cast<std::size_t>(k)]; }
  /// Number of observations of motion `k`.
  Eigen::Index count(Eigen::Index k) const { return first(k + 1) - first(k); }

 private:
  std::vector<PoseMotion> motions_;
  std::vector<Eigen::Index> first_;
};

/// Model with some effects, and its fit.
struct PoseFit {
  std::vector<PoseHypothesis> effects;
  Eigen::VectorXd value;     ///< parameters of all effects, SI
  Eigen::Matrix3Xd e;        ///< observed − predicted at each observation [m]
  Eigen::VectorXd weight;    ///< Huber weight / variance of the axis, per entry of e in column order
  Eigen::MatrixXd jacobian;  ///< derivative of the prediction by value / scale

  /// Index of the effect's first parameter in `value`; −1: the model does not have the effect.
  Eigen::Index placeOf(std::string_view effect) const;
  /// Parameters of the effect; empty if the model does not have it.
  std::vector<double> valuesOf(std::string_view effect) const;
};

/// Numbers of the pose model with these effects, whose parameters are `value`.
PoseNumbers numbersOf(const std::vector<PoseHypothesis>& effects, const Eigen::VectorXd& value);

/// Observed − predicted at all observations, 3 × observations [m].
Eigen::Matrix3Xd residualOf(const PoseData& data, const PoseNumbers& numbers);

/// Robust least squares from the start `value`: minimizes Σ ρ(e / s) by Levenberg–Marquardt within the bounds
/// of the parameters. ρ is Huber's function with the limit kHuber; s = 1.4826 median |e| per axis, computed
/// again in each iteration.
PoseFit fitPoses(const PoseData& data, std::vector<PoseHypothesis> effects, Eigen::VectorXd value);
inline constexpr double kHuber = 2.0;

/// Fit of the model with one more effect, started from `fit`.
PoseFit with(const PoseData& data, const PoseFit& fit, const PoseHypothesis& effect);
/// Fit of the model without one effect, started from `fit`.
PoseFit without(const PoseData& data, const PoseFit& fit, std::string_view effect);

/// Held-out residuals observed − predicted by cross-validation, 3 × observations [m]. Motion k belongs to
/// fold k mod kFolds. The parameters without a fold follow from one Gauss–Newton step of the fit.
Eigen::Matrix3Xd heldOut(const PoseData& data, const PoseFit& fit);

/// Covariance of the parameters `value`, valid for errors that are correlated within a trajectory: sandwich
/// estimator over trajectories (Liang and Zeger 1986).
Eigen::MatrixXd covarianceOf(const PoseData& data, const PoseFit& fit);

/// Sums of squares of e, by axis (as channel) and trajectory (as block).
BlockSquares squaresOf(const PoseData& data, const Eigen::Matrix3Xd& e);

}  // namespace capstan::diagnosis
