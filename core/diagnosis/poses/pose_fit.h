#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/hypotheses/pose_hypotheses.h"

namespace capstan::diagnosis {

/// Motions to fit to, their observations in one row.
class PoseData {
 public:
  explicit PoseData(std::vector<PoseMotion> motions);

  const std::vector<PoseMotion>& motions() const { return motions_; }
  Eigen::Index observations() const { return first_.back(); }
  Eigen::Index blocks() const { return static_cast<Eigen::Index>(motions_.size()); }
  /// Columns of motion `k` begin here; there is one more, the end.
  Eigen::Index first(Eigen::Index k) const { return first_[static_cast<std::size_t>(k)]; }
  Eigen::Index count(Eigen::Index k) const { return first(k + 1) - first(k); }

 private:
  std::vector<PoseMotion> motions_;
  std::vector<Eigen::Index> first_;
};

/// A model of some effects, fitted.
struct PoseFit {
  std::vector<PoseHypothesis> effects;
  Eigen::VectorXd value;     ///< numbers of all effects, SI
  Eigen::Matrix3Xd e;        ///< observed − predicted at each observation [m]
  Eigen::VectorXd weight;    ///< of each number of e, column by column: Huber's over the axis' variance
  Eigen::MatrixXd jacobian;  ///< of the prediction by value / scale

  /// Place of the effect's first number; −1: it is not in.
  Eigen::Index placeOf(std::string_view effect) const;
  std::vector<double> valuesOf(std::string_view effect) const;
};

PoseNumbers numbersOf(const std::vector<PoseHypothesis>& effects, const Eigen::VectorXd& value);

/// Observed − predicted of all observations.
Eigen::Matrix3Xd residualOf(const PoseData& data, const PoseNumbers& numbers);

/// Robust least squares: Σ ρ(e / s) by Levenberg and Marquardt within the parameters' bounds, ρ Huber's with
/// kHuber, s each axis' 1.4826 median |e|, brought up to date as the fit proceeds. Begins at `value`.
PoseFit fitPoses(const PoseData& data, std::vector<PoseHypothesis> effects, Eigen::VectorXd value);
inline constexpr double kHuber = 2.0;

/// The fit with one more effect, begun from it; and without one.
PoseFit with(const PoseData& data, const PoseFit& fit, const PoseHypothesis& effect);
PoseFit without(const PoseData& data, const PoseFit& fit, std::string_view effect);

/// Observed − predicted where each trajectory is predicted by the fit to the others: motions fall into kFolds
/// folds; without a fold, values go by one Gauss–Newton step.
Eigen::Matrix3Xd heldOut(const PoseData& data, const PoseFit& fit);

/// Covariance of the values, dependent errors within a trajectory allowed for: sandwich by trajectories
/// (Liang and Zeger 1986).
Eigen::MatrixXd covarianceOf(const PoseData& data, const PoseFit& fit);

/// Squares by axis and trajectory, as FitData has them by channel and block.
BlockSquares squaresOf(const PoseData& data, const Eigen::Matrix3Xd& e);

}  // namespace capstan::diagnosis
