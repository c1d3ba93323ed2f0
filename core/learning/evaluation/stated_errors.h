#pragma once

#include <array>
#include <vector>

#include "core/learning/model/correction_model.h"

/// Whether a correction is off by as much as it says.
namespace capstan::learning {

/// Errors of corrections in units of the σ that were stated for them.
struct StatedErrors {
  std::array<std::vector<double>, 6>
      ratio;  ///< |e| / σ, state by state, of x, y, z and of the rotation's parts

  void add(const learning::CorrectionModel& model, const std::vector<learning::State>& states);
  std::size_t states() const { return ratio[0].size(); }
  /// Share of an output's errors that are within `sigmas` stated σ; 0 without states.
  double within(std::size_t output, double sigmas) const;
};

/// Share of a normal distribution within ±`sigmas` of its σ, and the inverse of that.
double normalShare(double sigmas);
double normalSigmas(double share);

}  // namespace capstan::learning
