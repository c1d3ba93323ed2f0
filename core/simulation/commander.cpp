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
  if (excursion_ == Excursion::kMotion) {
    JointTarget target = motion_->at(motion_time_);
    target.velocity *= motion_rate_;
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
      if (command_ == MotionCommand::kMotion && next_ && !motion_done_ && rate_ == 0.0)
        begin(Excursion::kToMotion, trajectory_.at(path_time_).position, next_->at(0.0).position);
      break;
    case Excursion::kAway:
      if (elapsed_ >= length_) begin(Excursion::kThere, hard_stop_, hard_stop_);
      break;
    case Excursion::kThere:
      if (command_ != MotionCommand::kHardStop)
        begin(Excursion::kBack, hard_stop_, trajectory_.at(path_time_).position);
      break;
    case Excursion::kToMotion:
      if (elapsed_ < length_) break;
      excursion_ = Excursion::kMotion;
      motion_ = next_;
      motion_time_ = motion_rate_ = 0.0;
      break;
    case Excursion::kMotion:
      stepMotion(dt);
      break;
    case Excursion::kBack:
      if (elapsed_ >= length_) excursion_ = Excursion::kNone;
      break;
  }
}

void Commander::stepMotion(double dt) {
  const bool goes_on = command_ == MotionCommand::kMotion && next_ == motion_;
  motion_rate_ += std::clamp((goes_on ? 1.0 : 0.0) - motion_rate_, -dt / kSlowDown, dt / kSlowDown);
  motion_time_ = std::min(motion_time_ + motion_rate_ * dt, motion_->duration());
  const bool ended = motion_time_ >= motion_->duration();
  if (!ended && (goes_on || motion_rate_ > 0.0)) return;
  const Eigen::Vector3d here = motion_->at(motion_time_).position;
  motion_done_ = ended && goes_on;
  if (command_ == MotionCommand::kMotion && !motion_done_)
    begin(Excursion::kToMotion, here, next_->at(0.0).position);
  else
    begin(Excursion::kBack, here, trajectory_.at(path_time_).position);
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
