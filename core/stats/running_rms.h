#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>

namespace capstan::stats {

/// Root mean square of N-vectors, component by component. The squares are added in the order of arrival, so
/// that the same samples always give the same bits. A vector with a non-finite component is excluded.
template <int N>
class RunningRms {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  /// Adds one vector. Returns false when it was excluded.
  bool add(const Vector& error) {
    if (!error.allFinite()) return false;
    sum_of_squares_ += error.cwiseAbs2();
    ++count_;
    return true;
  }

  /// RMS per component, sqrt(Σ e² / n); NaN before the first vector.
  Vector value() const {
    if (count_ == 0) return Vector::Constant(std::numeric_limits<double>::quiet_NaN());
    return (sum_of_squares_ / static_cast<double>(count_)).cwiseSqrt();
  }
  std::uint64_t count() const { return count_; }

 private:
  Vector sum_of_squares_ = Vector::Zero();
  std::uint64_t count_ = 0;
};

}  // namespace capstan::stats
