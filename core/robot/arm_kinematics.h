#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/base/names.h"
#include "core/base/result.h"
#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

/// Reason why a tip position or tool pose has no joint position.
enum class ReachFault { kOutOfReach, kSingular, kOutsideLimits };

/// All joint positions with the same tip position (or tool pose), without a check of the joint limits.
template <class Q, int kCapacity>
struct Branches {
  std::array<Q, kCapacity> q;
  int count = 0;
  ReachFault fault = ReachFault::kOutOfReach;  ///< reason when count == 0

  void add(const Q& branch) { q[static_cast<std::size_t>(count++)] = branch; }
  const Q* begin() const { return q.data(); }
  const Q* end() const { return q.data() + count; }
};

/// Closed-form kinematics of a three-joint arm whose axes intersect in the origin of frame 0 (the remote
/// centre), and of tool roll, wrist and mean jaw angle at its end. q = (q1 [rad], q2 [rad], q3 [m], q4, q5,
/// q6 [rad]).
///
/// Inverse position: with marker (m_x, m_y, m_z) in frame 3 and h = d_3 + q3 + m_z,
///   |tip|² = m_x² + m_y² + h²                                    two signs of h
///   RotX(−alpha_1) tip = RotZ(phi_1) RotX(alpha_2) RotZ(phi_2) v(h)   its z row: two phi_2, then one phi_1
/// so that there are two or four branches. A tip is singular within kSingularRadius of the remote centre, or
/// when its direction from there is within kSingularAngle of axis 1; the marker in frame 3 likewise for
/// axis 2.
///
/// Limits: a branch is inside the limits when each joint lies within its limits, widened to contain the hard
/// stop and then by kLimitMargin of their range on both sides. The reason is that the hard stop of RAVEN-II
/// lies just outside the limits, and that the measured position of an arm at rest there can be a few standard
/// deviations of noise further out. Among the branches inside, the nearest to the last position is chosen.
/// The distance of each joint is relative to its range, so that radians and metres have equal weight.
class ArmKinematics {
 public:
  static constexpr double kSingularRadius = 1e-6;  ///< [m]
  static constexpr double kSingularAngle = 1e-6;   ///< [rad]
  static constexpr double kLimitMargin = 0.1;      ///< share of the joint's range

  using PositionBranches = Branches<Eigen::Vector3d, 4>;
  using PoseBranches = Branches<Vector6d, 8>;

  /// Throws base::InputError when the arm has no remote centre, or its wrist rows do not have the form in
  /// remote_centre.h.
  explicit ArmKinematics(const Description& description);

  /// Marker centre in frame 0 [m].
  Eigen::Vector3d tip(const Eigen::Vector3d& q) const;
  /// Jacobian d tip / d q in frame 0 [m/rad, m/rad, m/m].
  Eigen::Matrix3d tipJacobian(const Eigen::Vector3d& q) const;
  /// Transform frame 0 from frame i, i = 0…3.
  Eigen::Isometry3d frame(int i, const Eigen::Vector3d& q) const;

  PositionBranches positionBranches(const Eigen::Vector3d& tip) const;
  /// Branch inside the limits that is nearest to `near`.
  base::Result<Eigen::Vector3d, ReachFault> solvePosition(const Eigen::Vector3d& tip,
                                                          const Eigen::Vector3d& near) const;

  bool hasWrist() const { return has_wrist_; }
  /// Transform frame 0 from frame 6. Needs hasWrist().
  Eigen::Isometry3d toolPose(const Vector6d& q) const;
  /// All (q1 … q6) of a tool pose with an orthonormal rotation. Needs hasWrist(). The pose is also singular
  /// when the remote centre lies on the axis of the jaw, because q6 is then undetermined.
  PoseBranches poseBranches(const Eigen::Isometry3d& pose) const;
  /// Branch with joints 1–3 inside the limits that is nearest to `near`. Each wrist angle is shifted by
  /// multiples of 2π to the value nearest to `near`.
  base::Result<Vector6d, ReachFault> solvePose(const Eigen::Isometry3d& pose, const Vector6d& near) const;

  /// Whether joints 1–3 are inside the widened limits (see the class).
  bool insideLimits(const Eigen::Vector3d& q) const;

 private:
  PositionBranches branchesOf(const Eigen::Vector3d& point, const Eigen::Vector3d& in_frame3) const;
  void addTurns(const Eigen::Vector3d& w, const Eigen::Vector3d& v, double q3, PositionBranches& out) const;
  Eigen::Vector3d turnedNear(const Eigen::Vector3d& q, const Eigen::Vector3d& near) const;

  struct Turn {
    double sin, cos;
  };
  static Turn turnOf(double angle);

  std::array<Turn, 3> alpha_;  // of joints 1–3
  Turn theta3_;
  double theta1_, theta2_, d3_;
  Eigen::Vector3d marker_;
  Eigen::Vector3d low_, high_, range_;  // widened limits; range of the file's limits
  bool has_wrist_;
  double d4_ = 0.0, theta4_ = 0.0, theta5_ = 0.0, a6_ = 0.0, theta6_ = 0.0;
  double sign5_ = 1.0, sign6_ = 1.0;  // sin(alpha_5), sin(alpha_6)
};

}  // namespace capstan::robot

template <>
struct capstan::base::NamesOf<capstan::robot::ReachFault> {
  using F = capstan::robot::ReachFault;
  static constexpr std::array value = {
      std::pair{F::kOutOfReach, "out of reach"},
      std::pair{F::kSingular, "singular: at the remote centre or on a joint axis"},
      std::pair{F::kOutsideLimits, "outside the joint limits"}};
};
