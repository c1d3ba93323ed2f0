#pragma once

#include "core/stats/chi_square.h"

namespace capstan::estimation {

/// Chi-square gate on the innovation: open for a measurement whose NIS a consistent filter would show with
/// `probability`. A marker that jumps, or a reflection taken for it, shuts it.
class OcclusionGate {
 public:
  OcclusionGate(int dof, double probability) : threshold_(stats::chiSquareQuantile(dof, probability)) {}
  bool isOpen(double nis) const { return nis <= threshold_; }  // NaN: shut
  double threshold() const { return threshold_; }

 private:
  double threshold_;
};

}  // namespace capstan::estimation
