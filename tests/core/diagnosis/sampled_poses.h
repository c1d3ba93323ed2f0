/// Tables of tip poses made up here, apart from core/diagnosis: smooth motions through random places, a
/// tool that turns, cameras that see it wrongly. Continuous in time: nothing is interpolated.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"

namespace capstan::diagnosis::testing {

struct PoseWorld {
  std::uint64_t seed = 1;
  int trajectories = 60;
  double duration = 2.4;  ///< of each [s]
  double noise = 1e-4;    ///< of the cameras [m]
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero(), offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d marker = Eigen::Vector3d::Zero(), gap = Eigen::Vector3d::Zero();
  double scale = 0.0, delay = 0.0, command_ahead = 0.0;  ///< [1], [s], [s]
};

/// A motion from place to place and back, at rest in each.
class PoseCourse {
 public:
  PoseCourse(base::Random& random, double duration) : leg_(duration / kLegs) {
    for (int i = 0; i <= kLegs; ++i) {
      places_.emplace_back(random.uniform(-0.05, 0.02), random.uniform(-0.08, -0.02),
                           random.uniform(-0.15, -0.09));
      wrists_.emplace_back(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8));
    }
  }
  Eigen::Vector3d place(double t) const { return between(places_, t); }
  Eigen::Quaterniond rotation(double t) const {
    const Eigen::Vector3d v = between(wrists_, t);
    return Eigen::Quaterniond(Eigen::AngleAxisd(v.norm(), v.normalized()));
  }

 private:
  static constexpr int kLegs = 3;
  Eigen::Vector3d between(const std::vector<Eigen::Vector3d>& of, double t) const {
    const double in = std::clamp(t / leg_, 0.0, kLegs - 1e-9);
    const auto leg = static_cast<std::size_t>(in);
    const double s = in - static_cast<double>(leg);
    return of[leg] + (of[leg + 1] - of[leg]) * (s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));  // least jerk
  }
  double leg_;
  std::vector<Eigen::Vector3d> places_, wrists_;
};

/// Where the tip is every millisecond, behind the play, which begins anywhere.
inline std::vector<Eigen::Vector3d> behindPlay(const PoseCourse& course, const PoseWorld& world,
                                               base::Random& random) {
  std::vector<Eigen::Vector3d> tip;
  Eigen::Vector3d at = course.place(0.0);
  for (int axis = 0; axis < 3; ++axis) at[axis] += world.gap[axis] * random.uniform(-1.0, 1.0);
  for (int k = 0; k <= static_cast<int>(world.duration * 1e3) + 1; ++k) {
    const Eigen::Vector3d drive = course.place(1e-3 * k);
    for (int axis = 0; axis < 3; ++axis) {
      if (drive[axis] - at[axis] > world.gap[axis]) at[axis] = drive[axis] - world.gap[axis];
      if (drive[axis] - at[axis] < -world.gap[axis]) at[axis] = drive[axis] + world.gap[axis];
    }
    tip.push_back(at);
  }
  return tip;
}

inline const char* poseHeader() {
  return "task,traj,t_cam_s,t_robot_s,t_cmd_s,cam_x,cam_y,cam_z,cam_qx,cam_qy,cam_qz,cam_qw,robot_x,robot_y,"
         "robot_z,robot_qx,robot_qy,robot_qz,robot_qw,cmd_x,cmd_y,cmd_z,cmd_qx,cmd_qy,cmd_qz,cmd_qw\n";
}

inline std::string poseCells(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  return fmt::format(",{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}", p.x(), p.y(), p.z(), q.x(), q.y(),
                     q.z(), q.w());
}

/// A table as the recorders of such robots write it: a row some sixty times a second, each list with stamps
/// of its own.
inline std::string poseTable(const PoseWorld& world) {
  base::Random motion(world.seed, "motion"), sensor(world.seed, "sensor");
  const Eigen::Matrix3d rotation =
      world.rotation.isZero()
          ? Eigen::Matrix3d::Identity()
          : Eigen::AngleAxisd(world.rotation.norm(), world.rotation.normalized()).toRotationMatrix();
  std::string text = poseHeader();
  for (int k = 0; k < world.trajectories; ++k) {
    const PoseCourse course(motion, world.duration);
    const std::vector<Eigen::Vector3d> tip = behindPlay(course, world, motion);
    for (double t = 0.01; t < world.duration - 0.01; t += motion.uniform(0.012, 0.02)) {
      const double observed = t + motion.uniform(-0.003, 0.003), read = t + motion.uniform(-0.003, 0.003);
      const double then = std::clamp(observed - world.delay, 0.0, world.duration);
      const Eigen::Vector3d at =
          tip[static_cast<std::size_t>(std::lround(1e3 * then))] + course.rotation(then) * world.marker;
      Eigen::Vector3d measured = (1.0 + world.scale) * (rotation * at) + world.offset;
      for (double& x : measured) x += sensor.normal(0.0, world.noise);
      text +=
          fmt::format("0,{},{:.6f},{:.6f},{:.6f}", k, observed, read, t) +
          poseCells(measured, course.rotation(then)) + poseCells(course.place(read), course.rotation(read)) +
          poseCells(course.place(t + world.command_ahead), course.rotation(t + world.command_ahead)) + "\n";
    }
  }
  return text;
}

}  // namespace capstan::diagnosis::testing
