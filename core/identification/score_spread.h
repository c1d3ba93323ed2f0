#pragma once

#include <Eigen/Core>

#include "core/identification/parameter_filter.h"

namespace capstan::identification {

/// How much more the scores of a filter vary than it believes: the recursive form of the sandwich in batch.h.
/// Blocks of `block` seconds are taken as independent, and forgotten over `memory`.
class ScoreSpread {
 public:
  using Unknowns = ParameterFilter::Unknowns;
  using Square = Eigen::Matrix<double, ParameterFilter::kUnknowns, ParameterFilter::kUnknowns>;

  ScoreSpread(double block, double memory) : block_(block), memory_(memory) {}

  void add(double t, const ParameterFilter::Innovation& innovation);
  /// Factors >= 1 on the standard deviations of the unknowns whose covariance the filter states as P.
  Unknowns factors(const Square& covariance) const;

 private:
  void close();

  double block_, memory_;
  double start_ = 0.0;
  int count_ = 0;
  double blocks_ = 0.0;
  Unknowns score_ = Unknowns::Zero();
  Square block_information_ = Square::Zero(), information_ = Square::Zero(), meat_ = Square::Zero();
};

}  // namespace capstan::identification
