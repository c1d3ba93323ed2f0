#include "core/studies/disturbances.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <utility>

namespace capstan::studies {
namespace {

using Eigen::Vector3d;
using tracking::MotorSample;
using tracking::Sample;
using tracking::TipSample;

enum class From { kStart, kHalfTime };

double startOf(From from, double duration) { return from == From::kStart ? 0.0 : 0.5 * duration; }

/// Disturbance by `edit`, which changes the measured position of a tip.
Disturbance ofTips(std::string name, From from, std::function<void(Vector3d&)> edit) {
  return {std::move(name), {}, [from, edit = std::move(edit)](Sample& sample, double duration) {
            auto* tip = std::get_if<TipSample>(&sample);
            if (tip && tip->t >= startOf(from, duration)) edit(tip->position);
          }};
}

Disturbance shifted(double millimetres, From from) {
  const Vector3d direction = Vector3d(-0.9, -0.4, 0.17).normalized();
  return ofTips(fmt::format("cameras shifted {} mm {}", millimetres,
                            from == From::kStart ? "throughout" : "at half time"),
                from, [shift = Vector3d(1e-3 * millimetres * direction)](Vector3d& tip) { tip += shift; });
}

/// Rotation of the cameras about an axis through a point in front of the arm, as when a tripod is hit.
Disturbance rotated(double degrees) {
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(degrees * EIGEN_PI / 180.0, Vector3d(0.3, 0.8, 0.52).normalized()).matrix();
  const Vector3d centre(0.1, -0.5, -0.2);
  return ofTips(fmt::format("cameras rotated {}° at half time", degrees), From::kHalfTime,
                [=](Vector3d& tip) { tip = centre + rotation * (tip - centre); });
}

/// Scale of the measured positions about the cameras' position, as with a wrong focal length or baseline.
Disturbance scaled(double factor) {
  const Vector3d cameras(0.1, -0.5, -0.2);
  return ofTips(fmt::format("cameras' scale x{} throughout", factor), From::kStart,
                [=](Vector3d& tip) { tip = cameras + factor * (tip - cameras); });
}

Disturbance late(double seconds) {
  return {fmt::format("camera stamps {} ms late", 1e3 * seconds), {}, [seconds](Sample& sample, double) {
            if (auto* tip = std::get_if<TipSample>(&sample)) tip->t += seconds;
          }};
}

Disturbance slipped(int motor, double radians) {
  return {fmt::format("motor {} slips {} rad at half time", motor + 1, radians),
          {},
          [=](Sample& sample, double duration) {
            auto* turned = std::get_if<MotorSample>(&sample);
            if (turned && turned->t >= 0.5 * duration) turned->position(motor) += radians;
          }};
}

Disturbance hidden() {
  return {"cameras hidden for 60 s", {}, [](Sample& sample, double duration) {
            auto* tip = std::get_if<TipSample>(&sample);
            if (tip && std::abs(tip->t - 0.5 * duration) < 30.0) tip->position.setConstant(std::nan(""));
          }};
}

Disturbance stiffness(int joint, double factor) {
  return {fmt::format("robot file: stiffness of cable {} x{}", joint + 1, factor),
          [=](robot::Description& robot) {
            robot.drives[static_cast<std::size_t>(joint)].cable_stiffness *= factor;
          },
          {}};
}

Disturbance radius(int joint, double factor) {
  return {
      fmt::format("robot file: radius of pulley {} x{}", joint + 1, factor),
      [=](robot::Description& robot) { robot.drives[static_cast<std::size_t>(joint)].link_radius *= factor; },
      {}};
}

Disturbance friction(double factor) {
  return {fmt::format("robot file: friction of joints x{}", factor),
          [=](robot::Description& robot) {
            for (robot::Joint& joint : robot.joints) joint.friction.coulomb *= factor;
          },
          {}};
}

}  // namespace

std::vector<Disturbance> disturbances() {
  std::vector<Disturbance> all = {{"none", {}, {}}};
  for (const double millimetres : {1.2, 3.0, 12.0}) all.push_back(shifted(millimetres, From::kHalfTime));
  all.push_back(shifted(12.0, From::kStart));
  all.push_back(rotated(2.0));
  all.push_back(scaled(1.04));
  all.push_back(late(0.06));
  all.push_back(hidden());
  all.push_back(slipped(0, 1.0));
  all.push_back(slipped(1, 1.0));
  all.push_back(slipped(2, 2.0));
  for (int joint = 0; joint < 3; ++joint)
    for (const double factor : {0.1, 0.33, 3.0}) all.push_back(stiffness(joint, factor));
  for (const double factor : {0.75, 0.95, 1.2}) all.push_back(radius(0, factor));
  all.push_back(radius(1, 1.05));
  all.push_back(friction(3.0));
  return all;
}

}  // namespace capstan::studies
