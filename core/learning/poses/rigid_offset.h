#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace capstan::learning {

/// An observed pose and the commanded or reported pose at that instant: each [m] and a rotation, in frames of
/// their own.
struct PosePair {
  Eigen::Isometry3d observed = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d commanded = Eigen::Isometry3d::Identity();
};

/// How far two poses are apart: |Δt|² + (`lever` · angle)² [m²], the lever what a rotation counts for [m].
double squaredDistance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double lever);
inline constexpr double kLever = 0.05;  ///< of an instrument's tip

/// The rigid transform G that maps observed poses (o) nearest to commanded ones (c) (GPR paper, section
/// IV-B),
///     min Σ ‖G T_o − T_c‖²_F,
/// translations in levers: in closed form by the singular value decomposition of
///     Σ (t_c − t̄_c)(t_o − t̄_o)ᵀ / lever² + R_c R_oᵀ = U S Vᵀ,   R = U diag(1, 1, det U Vᵀ) Vᵀ
/// (Arun, Huang and Blostein, 1987; Umeyama, 1991). Identity of no pairs.
Eigen::Isometry3d rigidOffset(std::span<const PosePair> pairs, double lever = kLever);

struct MedianOptions {
  static constexpr int kDraws = 500;
  int sample = 3;      ///< pairs of a draw
  double reach = 2.5;  ///< of the robust standard deviation, within which a pair belongs
  double lever = kLever;
  std::uint64_t seed = 1;
};

struct MedianReport {
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< of all pairs that belong
  double deviation = 0.0;                                    ///< robust, of what belongs [m]
  std::vector<bool> belongs;                                 ///< by pair
};

/// Rigid offset by the least median of squares (Rousseeuw, Journal of the American Statistical Association 79
/// (1984); GPR paper, section IV-A): the offset of a few pairs whose median squared distance to all is least;
/// what lies further than `reach` robust deviations, 1.4826 (1 + 5 / (n − sample)) √median, does not belong,
/// and the offset of the rest is taken. Stands up to half of all pairs wrong. With fewer pairs than a sample
/// all belong.
MedianReport leastMedianOffset(std::span<const PosePair> pairs, const MedianOptions& options = {});

}  // namespace capstan::learning
