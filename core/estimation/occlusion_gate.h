#pragma once

namespace capstan::estimation {

/// Value that a chi-square variable of `dof` degrees of freedom stays below with `probability`. Boost.Math.
double chiSquareQuantile(int dof, double probability);

/// Chi-square gate on the innovation: open for a measurement whose NIS a consistent filter would show with
/// `probability`. A marker that jumps, or a reflection taken for it, shuts it.
class OcclusionGate {
 public:
  OcclusionGate(int dof, double probability) : threshold_(chiSquareQuantile(dof, probability)) {}
  bool isOpen(double nis) const { return nis <= threshold_; }  // NaN: shut
  double threshold() const { return threshold_; }

 private:
  double threshold_;
};

}  // namespace capstan::estimation
