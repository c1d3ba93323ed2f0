#pragma once

#include "core/stats/chi_square.h"

namespace capstan::estimation {

/// Chi-square gate on the innovation. It accepts a measurement whose NIS is at most the chi-square quantile
/// of `probability`. It rejects a marker that jumps, and a reflection that is detected as the marker.
class OcclusionGate {
 public:
  OcclusionGate(int dof, double probability) : threshold_(stats::chiSquareQuantile(dof, probability)) {}
  bool isOpen(double nis) const { return nis <= threshold_; }  // false for NaN
  double threshold() const { return threshold_; }

 private:
  double threshold_;
};

}  // namespace capstan::estimation
