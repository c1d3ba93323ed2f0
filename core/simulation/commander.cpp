#include "core/simulation/commander.h"

#include <algorithm>

namespace capstan::simulation {
namespace {

constexpr double kSlowDown = 0.5;  // time from full speed to a halt [s]
constexpr double kSettled = 1.0 / 3.0;

}  // namespace

Commander::Commander(const Trajectory& trajectory, const Eigen::Vector3d& hard_stop)
    : trajectory_(trajectory), hard_stop_(hard_stop), from_(hard_stop), to_(hard_stop) {}

JointTarget Commander::step(double dt) {
  stepExcursion(dt);
  const double wanted = command_ == MotionCommand::kRun && excursion_ == Excursion::kNone ? 1.0 : 0.0;
  rate_ += std::clamp(wanted - rate_, -dt / kSlowDown, dt / kSlowDown);
  path_time_ = std::min(path_time_ + rate_ * dt, trajectory_.duration());
  return target();
}

JointTarget Commander::target() const {
  if (excursion_ == Excursion::kNone) {
    JointTarget target = trajectory_.at(path_time_);
    target.velocity *= rate_;
    return target;
  }
  const auto [progress, progress_rate] = minimumJerk(elapsed_, length_);
  return {from_ + progress * (to_ - from_), progress_rate * (to_ - from_)};
}

void Commander::stepExcursion(double dt) {
  elapsed_ += dt;
  switch (excursion_) {
    case Excursion::kNone:
      if (command_ == MotionCommand::kHardStop && rate_ == 0.0)
        begin(Excursion::kAway, trajectory_.at(path_time_).position, hard_stop_);
      break;
    case Excursion::kAway:
      if (elapsed_ >= length_) begin(Excursion::kThere, hard_stop_, hard_stop_);
      break;
    case Excursion::kThere:
      if (command_ != MotionCommand::kHardStop)
        begin(Excursion::kBack, hard_stop_, trajectory_.at(path_time_).position);
      break;
    case Excursion::kBack:
      if (elapsed_ >= length_) excursion_ = Excursion::kNone;
      break;
  }
}

void Commander::begin(Excursion excursion, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  excursion_ = excursion;
  from_ = from;
  to_ = to;
  elapsed_ = 0.0;
  length_ = quinticDuration(from, to);
}

bool Commander::finished() const {
  return excursion_ == Excursion::kNone && command_ == MotionCommand::kRun &&
         path_time_ >= trajectory_.duration();
}

bool Commander::atHardStop() const { return excursion_ == Excursion::kThere && elapsed_ >= kSettled; }

}  // namespace capstan::simulation
