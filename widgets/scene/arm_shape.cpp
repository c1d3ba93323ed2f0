#include "widgets/scene/arm_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/robot/arm_kinematics.h"

namespace capstan::widgets {

namespace {

using Eigen::Vector3d;

constexpr double kLinkRadius = 0.011;
constexpr double kCableRadius = 0.0026;
constexpr double kCableGap = 0.011;

/// Axis of the joint after `row`, in the frame before it.
Vector3d nextAxis(const robot::DhRow& row) { return {0.0, -std::sin(row.alpha), std::cos(row.alpha)}; }

double sideOf(const Vector3d& centre_of_mass, const Vector3d& axis) {
  return centre_of_mass.dot(axis) < 0.0 ? -1.0 : 1.0;
}

/// Great-circle arc of `radius` between two unit vectors.
std::vector<Vector3d> arc(const Vector3d& from, const Vector3d& to, double radius) {
  constexpr int kSteps = 24;
  const double angle = std::acos(std::clamp(from.dot(to), -1.0, 1.0));
  std::vector<Vector3d> path;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = static_cast<double>(i) / kSteps;
    path.push_back(radius * (std::sin((1.0 - s) * angle) * from + std::sin(s * angle) * to) /
                   std::sin(angle));
  }
  return path;
}

std::vector<Vector3d> ring(const Vector3d& centre, const Vector3d& axis, double radius) {
  constexpr int kSteps = 48;
  const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  std::vector<Vector3d> path;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 2.0 * M_PI * i / kSteps;
    path.push_back(centre + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return path;
}

/// Radius about the remote centre at which an arc between the axes has its centre of mass at the position in
/// the robot file.
double arcRadius(const robot::Joint& joint, const Vector3d& from, const Vector3d& to) {
  const double half = 0.5 * std::acos(std::clamp(from.dot(to), -1.0, 1.0));
  return joint.link.centre_of_mass.norm() / std::max(0.3, std::cos(half));
}

}  // namespace

ArmShape shapeOf(const robot::Description& robot) {
  const auto& [j1, j2, j3] = std::tie(robot.joints[0], robot.joints[1], robot.joints[2]);
  const Vector3d z = Vector3d::UnitZ();
  const Vector3d axis1 = sideOf(j1.link.centre_of_mass, z) * z;  // in frames 0 and 1
  const Vector3d axis2_in1 = sideOf(j1.link.centre_of_mass, nextAxis(j2.dh)) * nextAxis(j2.dh);
  const Vector3d axis2 = sideOf(j2.link.centre_of_mass, z) * z;  // in frame 2
  const Vector3d axis3_in2 = nextAxis(j3.dh);
  const double r = std::max(arcRadius(j1, axis1, axis2_in1), arcRadius(j2, axis2, axis3_in2));
  const double low = std::min(j3.limit_low, j3.homing) + j3.dh.d,
               high = std::max(j3.limit_high, j3.homing) + j3.dh.d;

  ArmShape shape;
  shape.links.push_back({0, {axis1 * r, axis1 * (r + 0.10)}, 1.6 * kLinkRadius});
  shape.links.push_back({1, arc(axis1, axis2_in1, r), kLinkRadius});
  shape.links.push_back({2, arc(axis2, axis3_in2, r), kLinkRadius});
  shape.links.push_back({2, {axis3_in2 * (low - 0.02), axis3_in2 * (high + 0.02)}, 0.6 * kLinkRadius});
  shape.links.push_back({3, {Vector3d(0, 0, -0.02), Vector3d(0, 0, 0.02)}, 1.5 * kLinkRadius});
  shape.shaft.push_back({3, {Vector3d::Zero(), robot.marker}, 0.004});

  const double pulley1 = robot.drives[0].link_radius, pulley2 = robot.drives[1].link_radius;
  const double out1 = r + 0.03, out2 = r + 0.03;
  auto& [cable1, cable2, cable3] = shape.cables;
  cable1.push_back({1, ring(axis1 * out1, z, pulley1), kCableRadius});
  const Vector3d side = z.unitOrthogonal();
  for (const double s : {-1.0, 1.0})
    cable1.push_back(
        {0, {axis1 * out1 + s * pulley1 * side, axis1 * (r + 0.10) + s * 0.02 * side}, kCableRadius});
  cable2.push_back({1, arc(axis1, axis2_in1, r + 2.0 * kCableGap), kCableRadius});
  cable2.push_back({2, ring(axis2 * out2, z, pulley2), kCableRadius});
  cable3.push_back({1, arc(axis1, axis2_in1, r + 3.2 * kCableGap), kCableRadius});
  cable3.push_back({2, arc(axis2, axis3_in2, r + 2.0 * kCableGap), kCableRadius});
  const Vector3d beside = axis3_in2.unitOrthogonal() * kCableGap;
  cable3.push_back(
      {2, {axis3_in2 * (low - 0.02) + beside, axis3_in2 * (high + 0.02) + beside}, kCableRadius});
  shape.marker = robot.marker;
  shape.marker_radius = robot.marker_radius;
  return shape;
}

std::array<Eigen::Vector3d, 2> reachOf(const robot::Description& robot) {
  constexpr int kSteps = 6;
  const robot::ArmKinematics arm(robot);
  std::array<Vector3d, 2> box{Vector3d::Constant(1e9), Vector3d::Constant(-1e9)};
  for (int n = 0; n < kSteps * kSteps * kSteps; ++n) {
    const int step[3] = {n % kSteps, n / kSteps % kSteps, n / (kSteps * kSteps)};
    Vector3d q;
    for (int i = 0; i < 3; ++i) {
      const auto& joint = robot.joints[static_cast<std::size_t>(i)];
      q(i) = joint.limit_low + (joint.limit_high - joint.limit_low) * step[i] / (kSteps - 1.0);
    }
    const Vector3d tip = arm.tip(q);
    box[0] = box[0].cwiseMin(tip);
    box[1] = box[1].cwiseMax(tip);
  }
  return box;
}

}  // namespace capstan::widgets
