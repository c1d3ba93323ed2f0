#pragma once

#include <Eigen/Core>

#include "core/identification/parameter_filter.h"

namespace capstan::identification {

/// Ratio of the spread of a filter's scores to the spread that the filter assumes: the recursive form of the
/// covariance in batch.h, of innovations whitened by their covariance. It is measured over blocks of `block`
/// seconds, and predicted for the forces of ModelDiscrepancy. Blocks count as independent and fade with time
/// constant `memory`. Times count from the first observation.
class ScoreSpread {
 public:
  using Unknowns = ParameterFilter::Unknowns;
  using Square = Eigen::Matrix<double, ParameterFilter::kUnknowns, ParameterFilter::kUnknowns>;

  ScoreSpread(double block, double discrepancy_memory, double memory)
      : block_(block), discrepancy_memory_(discrepancy_memory), memory_(memory) {}

  /// Adds an innovation at `t` [s]. `by_discrepancy`: change of the tip by an unknown force of one standard
  /// deviation on each joint [m].
  void add(double t, const ParameterFilter::Innovation& innovation, const Eigen::Matrix3d& by_discrepancy);
  /// Factors >= 1 on the standard deviations of the unknowns; `covariance` is the filter's own.
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
