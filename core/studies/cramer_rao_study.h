#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/stats/interval.h"

namespace capstan::studies {

/// Numbers that do not exist are NaN.
inline Eigen::Vector3d noVector() {
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// How close the tracking filter comes to the posterior Cramér–Rao bound where its model is true.
struct CramerRaoOptions {
  int runs = 200;
  double duration = 10.0;        ///< of each run [s], from the beginning of a block transfer
  double settling = 1.0;         ///< excluded at the beginning [s]
  double pixel_sigma = 0.3;      ///< of each image coordinate of a marker [px]
  bool coulomb_friction = true;  ///< false: joints without it, in truth and filter
  std::uint64_t seed = 1;
  int threads = 2;  ///< the result does not depend on it
  /// Time that all runs go through before any goes on [s]: the memory held for the bound, 7 kB a step of it;
  /// the result does not depend on it.
  double segment = 1.0;
};

/// The measurement noise that a filter assumes.
enum class StatedNoise {
  kPixels,   ///< each sample's own: J⁻¹ Sigma_pixels J⁻ᵀ (tracking::CameraNoise)
  kConstant  ///< diag of its mean over the movement: the best that a constant can be
};
inline constexpr std::size_t kStatedNoises = 2;

struct CramerRaoStudy {
  int runs = 0;
  std::uint64_t updates = 0;            ///< camera samples of a run, on average
  Eigen::Vector3d bound = noVector();   ///< √ mean bound on the joint positions' variance [rad, rad, m]
  Eigen::Vector3d camera = noVector();  ///< RMS error of q_cam [rad, rad, m]
  Eigen::Vector3d constant_sigma = noVector();  ///< √ of the constant R [rad, rad, m]
  std::array<Eigen::Vector3d, kStatedNoises> rms{noVector(), noVector()};    ///< of the filter's positions
  std::array<Eigen::Vector3d, kStatedNoises> ratio{noVector(), noVector()};  ///< rms / bound
  std::array<std::array<stats::Interval, 3>, kStatedNoises> interval{};      ///< of ratio, 95 %, over runs
  std::array<double, kStatedNoises> nees{}, nis{};  ///< means over their degrees of freedom (6 and 3)
  std::uint64_t rescues = 0;
  bool cancelled = false;  ///< nothing else is filled in
};

/// Monte Carlo over `runs` truths drawn from the filter's own model, tracking::CableArmModel of the left
/// RAVEN-II with the process noise and initial spread of the default tracking options; motors as a block
/// transfer's with unstretched cables, known without error; at the camera's rate two cameras see the marker
/// with Gaussian pixel noise. Filters observe q_cam, triangulated and through the inverse kinematics, as the
/// pipeline does; the bound is that of any estimator that sees the pixels themselves. All filters see the
/// same samples. Deterministic and cancellable.
CramerRaoStudy studyCramerRao(const CramerRaoOptions& options, base::Progress& progress);

}  // namespace capstan::studies

template <>
struct capstan::base::NamesOf<capstan::studies::StatedNoise> {
  using N = capstan::studies::StatedNoise;
  static constexpr std::array value = {std::pair{N::kPixels, "pixels"}, std::pair{N::kConstant, "constant"}};
};
