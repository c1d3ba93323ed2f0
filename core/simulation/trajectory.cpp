#include "core/simulation/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/simulation/block_transfer.h"
#include "core/simulation/recorded_trajectory.h"

namespace capstan::simulation {
namespace {

class Hold final : public Trajectory {
 public:
  Hold(const HoldSpec& spec, double duration) : position_(spec.position), duration_(duration) {}
  JointTarget at(double) const override { return {position_, Eigen::Vector3d::Zero()}; }
  double duration() const override { return duration_; }
  double nextInstant(double t) const override { return t + duration_ + 1.0; }

 private:
  Eigen::Vector3d position_;
  double duration_;
};

class Sinusoid final : public Trajectory {
 public:
  Sinusoid(const SinusoidSpec& spec, double duration) : spec_(spec), duration_(duration) {}

  JointTarget at(double t) const override {
    t = std::clamp(t, 0.0, duration_);
    const double ramp = std::min(2.0, 0.5 * duration_);
    const bool early = t < 0.5 * duration_;
    const auto [gain, gain_rate] = minimumJerk(early ? t : duration_ - t, ramp);
    const Eigen::Array3d omega = 2.0 * std::numbers::pi * spec_.frequency.array();
    const Eigen::Array3d sine = (omega * t).sin(), cosine = (omega * t).cos(),
                         amplitude = spec_.amplitude.array();
    return {spec_.centre + (gain * amplitude * sine).matrix(),
            (amplitude * (gain * omega * cosine + (early ? gain_rate : -gain_rate) * sine)).matrix()};
  }
  double duration() const override { return duration_; }
  double nextInstant(double t) const override {  // a long sinusoid repeats: its checks meet every phase
    return t + std::max(kDenseStep, duration_ / kMostInstants);
  }

 private:
  static constexpr double kMostInstants = 1e6;
  SinusoidSpec spec_;
  double duration_;
};

class HardStop final : public Trajectory {
 public:
  HardStop(const HardStopSpec& spec, const Eigen::Vector3d& stop)
      : spec_(spec), stop_(stop), way_(quinticDuration(spec.start, stop)) {}

  JointTarget at(double t) const override {
    const bool away = t < way_ + 0.5 * spec_.rest;
    const auto [progress, rate] = minimumJerk(away ? t : duration() - t, way_);
    const Eigen::Vector3d travel = stop_ - spec_.start;
    return {spec_.start + progress * travel, (away ? rate : -rate) * travel};
  }
  double duration() const override { return 2.0 * way_ + spec_.rest; }

 private:
  HardStopSpec spec_;
  Eigen::Vector3d stop_;
  double way_;
};

[[noreturn]] void refuse(TrajectoryKind kind, int joint, double value, double t, const std::string& reason) {
  throw base::InputError(
      {"trajectory", 0, std::string(base::nameOf(kind)) + ", joint " + std::to_string(joint + 1),
       base::yamlText(value), reason + " at t = " + base::yamlText(std::round(1e3 * t) / 1e3) + " s",
       "Choose a smaller or slower movement"});
}

/// Throws base::InputError unless the trajectory stays inside the limits (widened to contain the hard stop)
/// and below the highest speeds at every instant of nextInstant().
void requireFeasible(const Trajectory& trajectory, TrajectoryKind kind, const robot::Description& robot) {
  constexpr double kSlack = 1e-9;
  bool last = false;
  for (double t = 0.0; !last; t = trajectory.nextInstant(t)) {
    last = t >= trajectory.duration();
    const JointTarget target = trajectory.at(t);
    for (int i = 0; i < 3; ++i) {
      const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
      const double low = std::min(joint.limit_low, joint.homing),
                   high = std::max(joint.limit_high, joint.homing);
      const double q = target.position[i], dq = target.velocity[i];
      if (!(q >= low - kSlack && q <= high + kSlack))
        refuse(kind, i, q, t, "is outside " + base::yamlText(low) + "..." + base::yamlText(high));
      if (!(std::abs(dq) <= joint.max_speed))
        refuse(kind, i, dq, t, "is faster than " + base::yamlText(joint.max_speed));
    }
  }
}

std::unique_ptr<Trajectory> build(const TrajectorySpec& spec, const robot::Description& robot,
                                  std::uint64_t seed) {
  switch (spec.kind) {
    case TrajectoryKind::kHold:
      return std::make_unique<Hold>(spec.hold, spec.duration);
    case TrajectoryKind::kSinusoid:
      return std::make_unique<Sinusoid>(spec.sinusoid, spec.duration);
    case TrajectoryKind::kBlockTransfer:
      return std::make_unique<BlockTransfer>(spec.block_transfer, spec.duration, robot, seed);
    case TrajectoryKind::kRecorded:
      return recordedTrajectory(spec.recorded.file);
    case TrajectoryKind::kHardStop:
      break;
  }
  return std::make_unique<HardStop>(spec.hard_stop, robot::homingOf(robot));
}

}  // namespace

std::unique_ptr<Trajectory> makeTrajectory(const TrajectorySpec& spec, const robot::Description& robot,
                                           std::uint64_t seed) {
  std::unique_ptr<Trajectory> trajectory = build(spec, robot, seed);
  requireFeasible(*trajectory, spec.kind, robot);
  return trajectory;
}

double quinticDuration(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d speed(0.5, 0.5, 0.1);  // [rad/s, rad/s, m/s]
  constexpr double kPeak = 1.875;              // peak speed by mean speed of the minimum-jerk profile
  return std::max(0.5, kPeak * (to - from).cwiseAbs().cwiseQuotient(speed).maxCoeff());
}

}  // namespace capstan::simulation
