#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/names.h"
#include "core/vision/camera.h"

namespace capstan::vision {

enum class TriangulationFault { kNone, kParallelRays, kBehindCamera };

struct Triangulation {
  TriangulationFault fault = TriangulationFault::kParallelRays;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in the left camera's frame [m]
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();     ///< covariance of position, to first order in the pixels' sigma [m²]
  double epipolar_residual = 0.0;  ///< signed distance of the right pixel from the left pixel's epipolar
                                   ///< line, distortion removed [px]
  double chi_square = 0.0;  ///< weighted squared reprojection error of `position`; one degree of freedom
  bool found() const { return fault == TriangulationFault::kNone; }
};

/// Triangulates a point from its pixels in both cameras of a rig. It minimises the weighted reprojection
/// error, by Gauss–Newton steps on the four image coordinates from the mid-point of the two rays. No
/// allocation; one point takes about a microsecond.
class Triangulator {
 public:
  explicit Triangulator(const StereoRig& rig);

  /// Triangulates two pixels of the distorted images. sigma_px_…: standard deviations per axis [px], > 0.
  Triangulation triangulate(const Eigen::Vector2d& left_px, const Eigen::Vector2d& right_px,
                            double sigma_px_left, double sigma_px_right) const;
  const StereoRig& rig() const { return rig_; }

 private:
  StereoRig rig_;
  Eigen::Matrix3d rotation_;     ///< right_R_left
  Eigen::Vector3d translation_;  ///< of right_from_left [m]
  Eigen::Matrix3d essential_;    ///< x_rightᵀ E x_left = 0
};

}  // namespace capstan::vision

template <>
struct capstan::base::NamesOf<capstan::vision::TriangulationFault> {
  using F = capstan::vision::TriangulationFault;
  static constexpr std::array value = {std::pair{F::kNone, "ok"},
                                       std::pair{F::kParallelRays, "parallel rays"},
                                       std::pair{F::kBehindCamera, "behind a camera"}};
};
