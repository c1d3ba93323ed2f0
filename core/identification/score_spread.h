#pragma once

#include <Eigen/Core>

#include "core/identification/parameter_filter.h"

namespace capstan::identification {

/// How much more the scores of a filter vary than it assumes: the recursive form of the covariance in
/// batch.h, of scores as found over blocks of `block` seconds, and of those that the forces of
/// ModelDiscrepancy would make. Blocks are taken as independent, and forgotten over `memory`. Times count
/// from the first observation.
class ScoreSpread {
 public:
  using Unknowns = ParameterFilter::Unknowns;
  using Square = Eigen::Matrix<double, ParameterFilter::kUnknowns, ParameterFilter::kUnknowns>;

  ScoreSpread(double block, double discrepancy_memory, double memory)
      : block_(block), discrepancy_memory_(discrepancy_memory), memory_(memory) {}

  /// `by_discrepancy`: tip by an unknown force of one standard deviation on each joint [m].
  void add(double t, const ParameterFilter::Innovation& innovation, const Eigen::Matrix3d& by_discrepancy);
  /// Factors >= 1 on the standard deviations of the unknowns whose covariance the filter states as P.
  Unknowns factors(const Square& covariance) const;

 private:
  void close(double t);
  void closeDiscrepancy(double t);

  double block_, discrepancy_memory_, memory_;
  bool started_ = false;
  double start_ = 0.0, discrepancy_start_ = 0.0;
  double blocks_ = 0.0;
  Unknowns score_ = Unknowns::Zero();
  Square block_information_ = Square::Zero(), information_ = Square::Zero(), meat_ = Square::Zero();
  Eigen::Matrix<double, ParameterFilter::kUnknowns, 3> discrepancy_score_ =
      Eigen::Matrix<double, ParameterFilter::kUnknowns, 3>::Zero();
  Square discrepancy_ = Square::Zero();
};

}  // namespace capstan::identification
