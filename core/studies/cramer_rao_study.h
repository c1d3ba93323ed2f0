#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/stats/interval.h"

namespace capstan::studies {

/// Vector of NaN, for numbers that do not exist.
inline Eigen::Vector3d noVector() {
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// Options of the comparison of the tracking filter with the posterior Cramér–Rao bound, for a true model.
struct CramerRaoOptions {
  int runs = 200;                ///< number of runs
  double duration = 10.0;        ///< duration of each run from the beginning of a block transfer [s]
  double settling = 1.0;         ///< excluded time at the beginning [s]
  double pixel_sigma = 0.3;      ///< noise of each image coordinate of a marker [px]
  bool coulomb_friction = true;  ///< false: joints without Coulomb friction, in truth and filter
  std::uint64_t seed = 1;
  int threads = 2;  ///< number of worker threads; the result does not depend on it
  /// Length of the time segments that all runs complete before the next one [s]. It determines the memory for
  /// the bound, 7 kB per step of a segment; the result does not depend on it.
  double segment = 1.0;
};

/// The measurement noise that a filter assumes.
enum class StatedNoise {
  kPixels,   ///< covariance of each sample: J⁻¹ Sigma_pixels J⁻ᵀ (tracking::CameraNoise)
  kConstant  ///< diagonal of its mean over the movement: the best constant
};
inline constexpr std::size_t kStatedNoises = 2;

struct CramerRaoStudy {
  int runs = 0;
  std::uint64_t updates = 0;            ///< mean number of camera samples per run
  Eigen::Vector3d bound = noVector();   ///< √ mean bound on the joint positions' variance [rad, rad, m]
  Eigen::Vector3d camera = noVector();  ///< RMS error of q_cam [rad, rad, m]
  Eigen::Vector3d constant_sigma = noVector();  ///< √ of the constant R [rad, rad, m]
  std::array<Eigen::Vector3d, kStatedNoises> rms{noVector(), noVector()};  ///< RMS of the filter's positions
  std::array<Eigen::Vector3d, kStatedNoises> ratio{noVector(), noVector()};  ///< rms / bound
  std::array<std::array<stats::Interval, 3>, kStatedNoises>
      interval{};                                   ///< 95 % interval of ratio, over runs
  std::array<double, kStatedNoises> nees{}, nis{};  ///< mean NEES / 6 and NIS / 3 degrees of freedom
  std::uint64_t rescues = 0;
  bool cancelled = false;  ///< true: nothing else is filled in
};

/// Runs the study: Monte Carlo over `runs` truths drawn from the filter's own model. That is
/// tracking::CableArmModel of the left RAVEN-II with the process noise and initial covariance of the default
/// tracking options. The motors move as in a block transfer with unstretched cables and are known without
/// error. Two cameras observe the marker with Gaussian pixel noise. The filters use q_cam from triangulation
/// and inverse kinematics, as the pipeline does; the bound is that of any estimator that uses the pixels
/// themselves. All filters get the same samples. Deterministic and cancellable.
CramerRaoStudy studyCramerRao(const CramerRaoOptions& options, base::Progress& progress);

}  // namespace capstan::studies

template <>
struct capstan::base::NamesOf<capstan::studies::StatedNoise> {
  using N = capstan::studies::StatedNoise;
  static constexpr std::array value = {std::pair{N::kPixels, "pixels"}, std::pair{N::kConstant, "constant"}};
};
