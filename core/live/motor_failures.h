#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/tracking/snapshot.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// Failure of a motor encoder. kFrozen: the position stays constant and the velocity is zero; kLost: both are
/// NaN.
struct MotorFailure {
  int motor = 0;      ///< 0, 1, 2
  double time = 0.0;  ///< [s], by the motor samples' clock
  tracking::MotorFault fault = tracking::MotorFault::kFrozen;
};

/// Parses "2@60" (motor 2 freezes at 60 s), "2@60:lost" or "all@60:frozen"; motors count from 1. Throws
/// base::InputError that names `option` and the text.
std::vector<MotorFailure> parseMotorFailure(const std::string& text, const std::string& option);

/// Applies encoder failures to motor samples, whose times must increase.
class MotorFailures {
 public:
  explicit MotorFailures(std::vector<MotorFailure> failures) : failures_(std::move(failures)) {}
  void apply(tracking::MotorSample& sample);

 private:
  std::vector<MotorFailure> failures_;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();  ///< q_m before the failure [rad]
};

/// A source whose motor encoders fail; the control of the robot itself is not affected.
class FailingMotors final : public tracking::Source {
 public:
  FailingMotors(tracking::Source& source, std::vector<MotorFailure> failures)
      : source_(source), failures_(std::move(failures)) {}

  const tracking::SourceInfo& info() const override { return source_.info(); }
  bool next(tracking::Sample& out) override;
  bool ready(std::chrono::milliseconds wait) override { return source_.ready(wait); }
  void discard() override { source_.discard(); }
  std::vector<tracking::SideStatus> sides() const override { return source_.sides(); }
  void block(bool left, bool right) override { source_.block(left, right); }

 private:
  tracking::Source& source_;
  MotorFailures failures_;
};

}  // namespace capstan::live
