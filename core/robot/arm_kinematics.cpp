#include "core/robot/arm_kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.h"
#include "core/robot/kinematics.h"
#include "core/robot/remote_centre.h"

namespace capstan::robot {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-12;  ///< largest relative excess of reach that counts as rounding

/// Angle that differs from `angle` by a multiple of 2π and is within π of `centre`.
double turnNear(double angle, double centre) {
  return centre + std::remainder(angle - centre, 2.0 * std::numbers::pi);
}

Vector3d rotatedX(double sin, double cos, const Vector3d& v) {
  return {v.x(), cos * v.y() - sin * v.z(), sin * v.y() + cos * v.z()};
}

Vector3d rotatedZ(double sin, double cos, const Vector3d& v) {
  return {cos * v.x() - sin * v.y(), sin * v.x() + cos * v.y(), v.z()};
}

}  // namespace

ArmKinematics::Turn ArmKinematics::turnOf(double angle) { return {std::sin(angle), std::cos(angle)}; }

ArmKinematics::ArmKinematics(const Description& description) : marker_(description.marker) {
  requireRemoteCentreArm(description);
  requireToolWrist(description);
  for (std::size_t i = 0; i < 3; ++i) {
    const Joint& joint = description.joints[i];
    const auto row = static_cast<Eigen::Index>(i);
    alpha_[i] = turnOf(joint.dh.alpha);
    range_[row] = joint.limit_high - joint.limit_low;
    low_[row] = std::min(joint.limit_low, joint.homing) - kLimitMargin * range_[row];
    high_[row] = std::max(joint.limit_high, joint.homing) + kLimitMargin * range_[row];
  }
  theta1_ = description.joints[0].dh.theta;
  theta2_ = description.joints[1].dh.theta;
  theta3_ = turnOf(description.joints[2].dh.theta);
  d3_ = description.joints[2].dh.d;
  has_wrist_ = !description.wrist.empty();
  if (!has_wrist_) return;
  const auto& wrist = description.wrist;
  d4_ = wrist[0].d;
  theta4_ = wrist[0].theta;
  theta5_ = wrist[1].theta;
  a6_ = wrist[2].a;
  theta6_ = wrist[2].theta;
  sign5_ = std::sin(wrist[1].alpha) > 0.0 ? 1.0 : -1.0;
  sign6_ = std::sin(wrist[2].alpha) > 0.0 ? 1.0 : -1.0;
}

Vector3d ArmKinematics::tip(const Vector3d& q) const {
  const Turn phi1 = turnOf(theta1_ + q[0]);
  const Turn phi2 = turnOf(theta2_ + q[1]);
  const Vector3d in3(marker_.x(), marker_.y(), marker_.z() + d3_ + q[2]);
  const Vector3d in2 = rotatedX(alpha_[2].sin, alpha_[2].cos, rotatedZ(theta3_.sin, theta3_.cos, in3));
  const Vector3d in1 = rotatedX(alpha_[1].sin, alpha_[1].cos, rotatedZ(phi2.sin, phi2.cos, in2));
  return rotatedX(alpha_[0].sin, alpha_[0].cos, rotatedZ(phi1.sin, phi1.cos, in1));
}

Isometry3d ArmKinematics::frame(int i, const Vector3d& q) const {
  CAPSTAN_ASSERT(i >= 0 && i <= 3);
  Matrix3d rotation = Matrix3d::Identity();
  const std::array<Turn, 3> theta = {turnOf(theta1_ + q[0]), turnOf(theta2_ + q[1]), theta3_};
  for (std::size_t k = 0; k < static_cast<std::size_t>(i); ++k) {
    const auto [s, c] = theta[k];
    const auto [sa, ca] = alpha_[k];
    Matrix3d step;
    step << c, -s, 0.0, ca * s, ca * c, -sa, sa * s, sa * c, ca;
    rotation = rotation * step;
  }
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = rotation;
  if (i == 3) pose.translation() = (d3_ + q[2]) * rotation.col(2);
  return pose;
}

Matrix3d ArmKinematics::tipJacobian(const Vector3d& q) const {
  const Vector3d point = tip(q);
  const Isometry3d third = frame(3, q);
  const Vector3d axis1 = rotatedX(alpha_[0].sin, alpha_[0].cos, Vector3d::UnitZ());
  const Vector3d axis2 = frame(2, q).linear().col(2);
  Matrix3d jacobian;
  jacobian << axis1.cross(point), axis2.cross(point), third.linear().col(2);
  return jacobian;
}

bool ArmKinematics::insideLimits(const Vector3d& q) const {
  return (q.array() >= low_.array()).all() && (q.array() <= high_.array()).all();
}

/// Adds both solutions of RotZ(phi_1) RotX(alpha_2) RotZ(phi_2) v = w: phi_2 from the z row,
/// a sin(phi_2) + b cos(phi_2) = c, and then phi_1.
void ArmKinematics::addTurns(const Vector3d& w, const Vector3d& v, double q3, PositionBranches& out) const {
  const auto [sin2, cos2] = alpha_[1];
  const double a = sin2 * v.x();
  const double b = sin2 * v.y();
  const double c = w.z() - cos2 * v.z();
  const double reach = std::hypot(a, b);
  const double w_reach = std::hypot(w.x(), w.y());
  if (std::abs(c) - reach > kRounding * w.norm()) return;
  if (std::min(reach, w_reach) <= kSingularAngle * w.norm()) {
    if (out.count == 0) out.fault = ReachFault::kSingular;
    return;
  }
  const double across = std::sqrt(std::max(0.0, (reach - c) * (reach + c)));
  for (const double side : {across, -across}) {
    const double phi2 = std::atan2(a, b) + std::atan2(side, c);
    const Turn turn = turnOf(phi2);
    const Vector3d x = rotatedX(sin2, cos2, rotatedZ(turn.sin, turn.cos, v));
    const double phi1 = std::atan2(w.y(), w.x()) - std::atan2(x.y(), x.x());
    const Vector3d middle = 0.5 * (low_ + high_);
    out.add({turnNear(phi1 - theta1_, middle[0]), turnNear(phi2 - theta2_, middle[1]), q3});
  }
}

ArmKinematics::PositionBranches ArmKinematics::branchesOf(const Vector3d& point,
                                                          const Vector3d& in_frame3) const {
  PositionBranches branches;
  const double distance = point.norm();
  const double aside = std::hypot(in_frame3.x(), in_frame3.y());
  if (distance <= kSingularRadius) {
    branches.fault = ReachFault::kSingular;
    return branches;
  }
  if (distance < aside * (1.0 - kRounding)) return branches;
  const Vector3d w = rotatedX(-alpha_[0].sin, alpha_[0].cos, point);
  const double along = std::sqrt(std::max(0.0, (distance - aside) * (distance + aside)));
  for (const double h : {along, -along}) {
    const Vector3d in3(in_frame3.x(), in_frame3.y(), h);
    const Vector3d v = rotatedX(alpha_[2].sin, alpha_[2].cos, rotatedZ(theta3_.sin, theta3_.cos, in3));
    addTurns(w, v, h - d3_ - in_frame3.z(), branches);
  }
  return branches;
}

ArmKinematics::PositionBranches ArmKinematics::positionBranches(const Vector3d& tip) const {
  return branchesOf(tip, marker_);
}

/// Angles of joints 1 and 2, shifted by multiples of 2π: nearest to `near` if inside the limits, else nearest
/// to the middle of the limits.
Vector3d ArmKinematics::turnedNear(const Vector3d& q, const Vector3d& near) const {
  Vector3d turned = q;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double candidate = turnNear(q[i], near[i]);
    if (candidate >= low_[i] && candidate <= high_[i]) turned[i] = candidate;
  }
  return turned;
}

base::Result<Vector3d, ReachFault> ArmKinematics::solvePosition(const Vector3d& tip,
                                                                const Vector3d& near) const {
  const PositionBranches branches = positionBranches(tip);
  if (branches.count == 0) return base::failure(branches.fault);
  Vector3d best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const Vector3d& branch : branches) {
    const Vector3d q = turnedNear(branch, near);
    const double distance = (q - near).cwiseQuotient(range_).squaredNorm();
    if (!insideLimits(q) || distance >= best_distance) continue;
    best = q;
    best_distance = distance;
  }
  if (!std::isfinite(best_distance)) return base::failure(ReachFault::kOutsideLimits);
  return best;
}

Isometry3d ArmKinematics::toolPose(const Vector6d& q) const {
  CAPSTAN_ASSERT(has_wrist_);
  const double right_angle = 0.5 * std::numbers::pi;
  const JointTransform roll({0.0, 0.0, d4_, theta4_}, JointType::kRevolute);
  const JointTransform wrist({sign5_ * right_angle, 0.0, 0.0, theta5_}, JointType::kRevolute);
  const JointTransform jaw({sign6_ * right_angle, a6_, 0.0, theta6_}, JointType::kRevolute);
  return frame(3, q.head<3>()) * roll.at(q[3]) * wrist.at(q[4]) * jaw.at(q[5]);
}

/// Let R = R06, phi_6 = theta_6 + q6 and the wrist centre p5 = p − a_6 R (cos phi_6, −sin phi_6, 0). The
/// wrist axis z5 = ±R (sin phi_6, cos phi_6, 0) is perpendicular to the roll axis, which passes through the
/// remote centre and p5. Therefore z5 · p5 = 0 = sin phi_6 (Rᵀp)_x + cos phi_6 (Rᵀp)_y, with two solutions
/// phi_6 that differ by π. Each p5 has up to four branches.
ArmKinematics::PoseBranches ArmKinematics::poseBranches(const Isometry3d& pose) const {
  CAPSTAN_ASSERT(has_wrist_);
  PoseBranches branches;
  const Matrix3d rotation = pose.linear();
  const Vector3d seen = rotation.transpose() * pose.translation();
  if (std::hypot(seen.x(), seen.y()) <= kSingularRadius) {
    branches.fault = ReachFault::kSingular;
    return branches;
  }
  for (const double turn : {1.0, -1.0}) {
    const double phi6 = std::atan2(-turn * seen.y(), turn * seen.x());
    const auto [sin6, cos6] = turnOf(phi6);
    const Vector3d centre = pose.translation() - a6_ * (rotation * Vector3d(cos6, -sin6, 0.0));
    const PositionBranches positions = branchesOf(centre, {0.0, 0.0, d4_});
    if (positions.count == 0 && branches.count == 0) branches.fault = positions.fault;
    Matrix3d rotation5;  // R05: x from the jaw, z the wrist axis
    rotation5.col(0) = rotation * Vector3d(cos6, -sin6, 0.0);
    rotation5.col(2) = sign6_ * (rotation * Vector3d(sin6, cos6, 0.0));
    rotation5.col(1) = rotation5.col(2).cross(rotation5.col(0));
    for (const Vector3d& q : positions) {
      const Matrix3d wrist =
          frame(3, q).linear().transpose() * rotation5;  // RotZ(phi_4) RotX(±90°) RotZ(phi_5)
      const double phi4 = std::atan2(sign5_ * wrist(0, 2), -sign5_ * wrist(1, 2));
      const double phi5 = std::atan2(sign5_ * wrist(2, 0), sign5_ * wrist(2, 1));
      Vector6d branch;
      branch << q, turnNear(phi4 - theta4_, 0.0), turnNear(phi5 - theta5_, 0.0),
          turnNear(phi6 - theta6_, 0.0);
      branches.add(branch);
    }
  }
  return branches;
}

base::Result<Vector6d, ReachFault> ArmKinematics::solvePose(const Isometry3d& pose,
                                                            const Vector6d& near) const {
  const PoseBranches branches = poseBranches(pose);
  if (branches.count == 0) return base::failure(branches.fault);
  Vector6d best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (const Vector6d& branch : branches) {
    Vector6d q = branch;
    q.head<3>() = turnedNear(branch.head<3>(), near.head<3>());
    for (Eigen::Index i = 3; i < 6; ++i) q[i] = turnNear(branch[i], near[i]);
    const double distance = (q - near).head<3>().cwiseQuotient(range_).squaredNorm() +
                            (q - near).tail<3>().squaredNorm() / (std::numbers::pi * std::numbers::pi);
    if (!insideLimits(q.head<3>()) || distance >= best_distance) continue;
    best = q;
    best_distance = distance;
  }
  if (!std::isfinite(best_distance)) return base::failure(ReachFault::kOutsideLimits);
  return best;
}

}  // namespace capstan::robot
