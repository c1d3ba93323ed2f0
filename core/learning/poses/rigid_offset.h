#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace capstan::learning {

/// An observed pose and the commanded or reported pose at that instant, each in its own frame [m].
struct PosePair {
  Eigen::Isometry3d observed = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d commanded = Eigen::Isometry3d::Identity();
};

/// Squared distance of two poses, |Δt|² + (`lever` · angle)² [m²]; `lever` converts rotations to lengths [m].
double squaredDistance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double lever);
inline constexpr double kLever = 0.05;  ///< [m], for an instrument's tip

/// Rigid transform G that best maps observed poses (o) to commanded ones (c) (GPR paper, section IV-B),
///     min Σ ‖G T_o − T_c‖²_F,
/// with translations divided by the lever. The closed form uses the singular value decomposition of
///     Σ (t_c − t̄_c)(t_o − t̄_o)ᵀ / lever² + R_c R_oᵀ = U S Vᵀ,   R = U diag(1, 1, det U Vᵀ) Vᵀ
/// (Arun, Huang and Blostein, 1987; Umeyama, 1991). Identity without pairs.
Eigen::Isometry3d rigidOffset(std::span<const PosePair> pairs, double lever = kLever);

struct MedianOptions {
  static constexpr int kDraws = 500;
  static constexpr std::size_t kSample = 3;  ///< number of pairs per draw
  static constexpr double kReach = 2.5;      ///< largest distance of an inlier, in robust standard deviations
  std::uint64_t seed = 1;
};

struct MedianReport {
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< rigid offset of all inliers
  double deviation = 0.0;                                    ///< robust standard deviation of the inliers [m]
  std::vector<bool> belongs;                                 ///< by pair: true for an inlier
};

/// Rigid offset by the least median of squares (Rousseeuw, Journal of the American Statistical Association 79
/// (1984); GPR paper, section IV-A). Offsets of random samples of kSample pairs are compared by their median
/// squared distance over all pairs. With the best of them, pairs within kReach robust standard deviations,
/// 1.4826 (1 + 5 / (n − kSample)) √median, are inliers; the result is the offset of all inliers. Up to half
/// of the pairs may be wrong. With fewer pairs than a sample all are inliers.
MedianReport leastMedianOffset(std::span<const PosePair> pairs, const MedianOptions& options = {});

}  // namespace capstan::learning
