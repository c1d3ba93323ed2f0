#include "tests/support/sample_poses.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/yaml.h"

namespace capstan::testing {
namespace {

using Eigen::Vector3d;

constexpr double kPeriod = 0.01;  ///< [s]

Eigen::Isometry3d poseOf(const Vector3d& position, const Vector3d& rotation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (rotation.norm() > 0.0)
    pose.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  pose.translation() = position;
  return pose;
}

/// One trajectory in the frame of the cameras: some centimetres at some centimetres a second.
struct Path {
  Vector3d middle, reach, phase, rate, rotation;

  explicit Path(base::Random& random) {
    for (int i = 0; i < 3; ++i) {
      middle[i] = random.uniform(-0.03, 0.03);
      reach[i] = random.uniform(0.008, 0.02);
      phase[i] = random.uniform(0.0, 6.28);
      rate[i] = random.uniform(2.0, 4.0);
      rotation[i] = random.uniform(-0.15, 0.15);
    }
  }
  Eigen::Isometry3d observed(double t) const {
    const Vector3d swing = (rate * t + phase).array().sin();
    return poseOf(middle + reach.cwiseProduct(swing), rotation + 0.2 * swing);
  }
  Vector3d velocity(double t) const {
    return reach.array() * rate.array() * (rate * t + phase).array().cos();
  }
  /// What has to be told for seen(t): the offset, millimetres by place, degrees by speed.
  Eigen::Isometry3d commanded(double t, double bias) const {
    const Eigen::Isometry3d at = observed(t);
    Eigen::Isometry3d commanded =
        sampleOffset() * at * poseOf(Vector3d::Zero(), 0.7 * velocity(t).x() * Vector3d::UnitX());
    commanded.translation() +=
        bias * Vector3d(std::sin(40.0 * at.translation().x()), std::cos(30.0 * at.translation().y()), 0.0);
    return commanded;
  }
};

std::string cells(const Eigen::Isometry3d& pose, double unit) {
  const Eigen::Quaterniond q(pose.linear());
  const Vector3d p = pose.translation() / unit;
  return fmt::format(",{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", p.x(), p.y(), p.z(), q.x(), q.y(),
                     q.z(), q.w());
}

constexpr const char* kNoObservation = ",0,0,0,0,0,0,1";

}  // namespace

Eigen::Isometry3d sampleOffset() { return poseOf({0.02, 0.01, -0.12}, {0.2, 0.0, 0.4}); }

std::string samplePoseTable(const SamplePoses& sample) {
  base::Random random(sample.seed, "sample poses"), other(sample.noise_seed, "noise of sample poses");
  std::string table = "task,traj";
  for (const char* name : {"cam", "robot", "cmd"}) {
    if (!sample.command && std::string(name) == "cmd") continue;
    table += fmt::format(",t_{0}_s,{0}_x,{0}_y,{0}_z,{0}_qx,{0}_qy,{0}_qz,{0}_qw", name);
  }
  table += '\n';
  for (int m = 0; m < sample.trajectories; ++m) {
    const Path path(random);
    const bool all = sample.outliers > 0 && m + 1 == sample.trajectories;
    for (int row = 0; row < sample.rows; ++row) {
      const double t = 5.0 * m + kPeriod * row, within = kPeriod * row;
      Vector3d noise(random.normal(), random.normal(), random.normal());
      if (sample.noise_seed > 0) noise = Vector3d(other.normal(), other.normal(), other.normal());
      Eigen::Isometry3d observed = path.observed(within);
      observed.translation() += sample.noise * noise;
      if (sample.turn_noise > 0.0) {
        base::Random& from = sample.noise_seed > 0 ? other : random;
        const Vector3d rotated(from.normal(), from.normal(), from.normal());
        observed.linear() *= poseOf(Vector3d::Zero(), sample.turn_noise * rotated).linear();
      }
      if (all || (row >= 20 && row < 20 + sample.outliers)) observed.translation().x() += 0.06;
      const bool observation = row < 40 || row >= 40 + sample.placeholders;
      table += fmt::format("{},{},{:.6f}", m / 10, m % 10, t) +
               (observation ? cells(observed, sample.unit) : kNoObservation);
      const Eigen::Isometry3d commanded = path.commanded(within + sample.clock_offset, sample.bias);
      Eigen::Isometry3d believed = commanded;
      believed.translation().z() += 1e-3;
      table += fmt::format(",{:.6f}", t) + cells(believed, sample.unit);
      if (sample.command) table += fmt::format(",{:.6f}", t) + cells(commanded, sample.unit);
      table += '\n';
    }
  }
  return table;
}

void writeSamplePoses(const std::filesystem::path& path, const SamplePoses& sample) {
  base::writeTextFile(path, samplePoseTable(sample));
}

}  // namespace capstan::testing
