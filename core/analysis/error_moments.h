#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

namespace capstan::analysis {

/// Sums over all errors of an estimator [rad, rad, m], in order of arrival, so that rms() equals
/// tracking::ErrorTable to the last bit. As there, an error with a component that is not finite is excluded.
struct ErrorMoments {
  std::uint64_t n = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();       ///< Σ e; NaN: not known
  Eigen::Vector3d absolute = Eigen::Vector3d::Zero();  ///< Σ |e|; NaN: not known
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();   ///< Σ e²

  void add(const Eigen::Vector3d& error) {
    if (!error.allFinite()) return;
    sum += error;
    absolute += error.cwiseAbs();
    squares += error.cwiseAbs2();
    ++n;
  }
  /// RMS sqrt(Σ e² / n); NaN without errors.
  Eigen::Vector3d rms() const { return mean(squares).cwiseSqrt(); }
  /// Mean Σ e / n, or with `of_absolute` Σ |e| / n.
  Eigen::Vector3d mean(bool of_absolute) const { return mean(of_absolute ? absolute : sum); }

  /// Moments of `n` errors of which only the RMS is known.
  static ErrorMoments ofRms(const Eigen::Vector3d& rms, std::uint64_t n) {
    const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    return {n, none, none, rms.cwiseAbs2() * static_cast<double>(n)};
  }

 private:
  Eigen::Vector3d mean(const Eigen::Vector3d& total) const {
    return n > 0 ? Eigen::Vector3d(total / static_cast<double>(n))
                 : Eigen::Vector3d(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  }
};

}  // namespace capstan::analysis
