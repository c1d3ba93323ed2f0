#pragma once

#include <Eigen/Geometry>
#include <array>

#include "core/base/names.h"
#include "core/base/result.h"
#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

/// Why no joint position belongs to a tip position or tool pose.
enum class ReachFault { kOutOfReach, kSingular, kOutsideLimits };

/// Every joint position with the same tip (or tool pose), limits not asked.
template <class Q, int kCapacity>
struct Branches {
  std::array<Q, kCapacity> q;
  int count = 0;
  ReachFault fault = ReachFault::kOutOfReach;  ///< why there is none; only while count == 0

  void add(const Q& branch) { q[static_cast<std::size_t>(count++)] = branch; }
  const Q* begin() const { return q.data(); }
  const Q* end() const { return q.data() + count; }
};

/// Closed-form kinematics of a three-joint arm whose axes meet in the origin of frame 0 (the remote centre),
/// and of the tool roll, wrist and mean jaw angle behind it. q = (q1 [rad], q2 [rad], q3 [m], q4, q5, q6
/// [rad]).
///
/// Inverse position: with marker (m_x, m_y, m_z) in frame 3 and h = d_3 + q3 + m_z,
///   |tip|² = m_x² + m_y² + h²                                    two signs of h
///   RotX(−alpha_1) tip = RotZ(phi_1) RotX(alpha_2) RotZ(phi_2) v(h)   its z row: two phi_2, then one phi_1
/// so two or four branches. Singular: the tip within kSingularRadius of the remote centre, or seen from there
/// within kSingularAngle of axis 1; the marker likewise on axis 2.
///
/// Limits: a branch counts as inside when each joint lies within the limits, widened to hold the hard stop
/// and then by kLimitMargin of their range on both sides. The hard stop of RAVEN-II lies just outside the
/// limits, and a camera sees an arm that rests there up to a few noise deviations further out. Of the
/// branches inside, the nearest to the last position wins; each joint's distance is measured in its range, so
/// that radians and metres weigh alike.
class ArmKinematics {
 public:
  static constexpr double kSingularRadius = 1e-6;  ///< [m]
  static constexpr double kSingularAngle = 1e-6;   ///< [rad]
  static constexpr double kLimitMargin = 0.1;      ///< share of the joint's range

  using PositionBranches = Branches<Eigen::Vector3d, 4>;
  using PoseBranches = Branches<Vector6d, 8>;

  /// Throws base::InputError when the arm has no remote centre, or wrist rows of another shape
  /// (remote_centre.h).
  explicit ArmKinematics(const Description& description);

  /// Marker centre in frame 0 [m].
  Eigen::Vector3d tip(const Eigen::Vector3d& q) const;
  /// d tip / d q: [m/rad, m/rad, m/m], frame 0.
  Eigen::Matrix3d tipJacobian(const Eigen::Vector3d& q) const;
  /// Frame 0 from frame i, i = 0…3.
  Eigen::Isometry3d frame(int i, const Eigen::Vector3d& q) const;

  PositionBranches positionBranches(const Eigen::Vector3d& tip) const;
  /// The branch inside the limits nearest to `near`.
  base::Result<Eigen::Vector3d, ReachFault> solvePosition(const Eigen::Vector3d& tip,
                                                          const Eigen::Vector3d& near) const;

  bool hasWrist() const { return has_wrist_; }
  /// Frame 0 from frame 6. Needs hasWrist().
  Eigen::Isometry3d toolPose(const Vector6d& q) const;
  /// Every (q1 … q6) of a tool pose, rotation orthonormal. Needs hasWrist(). Singular also where q6 is free:
  /// the remote centre on the axis of the jaw.
  PoseBranches poseBranches(const Eigen::Isometry3d& pose) const;
  /// The branch with joints 1–3 inside the limits nearest to `near`; wrist angles are the congruent ones
  /// nearest to `near`.
  base::Result<Vector6d, ReachFault> solvePose(const Eigen::Isometry3d& pose, const Vector6d& near) const;

  /// Inside the limits by the rule above.
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
