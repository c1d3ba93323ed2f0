#pragma once

#include <array>
#include <vector>

#include "core/learning/model/correction_model.h"

/// Comparison of a correction's errors with its stated standard deviations.
namespace capstan::learning {

/// Errors of corrections in units of their stated σ.
struct StatedErrors {
  /// |e| / σ of each state, by output: x, y, z and the components of the rotation.
  std::array<std::vector<double>, 6> ratio;

  void add(const learning::CorrectionModel& model, const std::vector<learning::State>& states);
  std::size_t states() const { return ratio[0].size(); }
  /// Share of an output's errors within `sigmas` times the stated σ; 0 without states.
  double within(std::size_t output, double sigmas) const;
};

/// Share of a normal distribution within ±`sigmas` σ, and its inverse function.
double normalShare(double sigmas);
double normalSigmas(double share);

}  // namespace capstan::learning
