#include "core/live/armed_drive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace capstan::live {
namespace {

const robot::Description& raven() {
  static const robot::Description robot = robot::defaultDescription();
  return robot;
}
constexpr std::array<double, 3> kSpeed = {0.2, 0.1, 0.02};
const Eigen::Vector3d kInside(0.8, 1.5, 0.4), kOutside(0.8, 1.5, 0.1);
const Eigen::Vector3d kStop(0.0, 2.399827721492203, 0.562);  // of the RAVEN-II's file

// Everything that can happen, in every order.

enum class Event { kMotors, kMotorsOutside, kArm, kDisarm, kHold, kRelease, kByHand, kFocus, kWait };
constexpr int kEvents = 9;
constexpr double kPeriod = 0.02, kPause = 0.09;  // [s]

/// Whether a set-point may be sent, said again from all that has happened, in other words than the drive's.
struct Oracle {
  double motors = -1e9, held = -1e9;  ///< times
  bool outside = false, armed = false, pressed = false;

  void judge(double now) {
    if (now - motors > ArmedDrive::kSilence) armed = false;
    if (!armed || now - held > ArmedDrive::kHold) pressed = false;
  }
  void take(Event event, double now) {
    switch (event) {
      case Event::kMotors:
      case Event::kMotorsOutside:
        motors = now, outside = event == Event::kMotorsOutside;
        if (outside) armed = false;
        break;
      case Event::kArm:
        armed = armed || (now - motors <= ArmedDrive::kSilence && !outside);
        break;
      case Event::kHold:
        if (armed && now - motors <= ArmedDrive::kSilence) held = now, pressed = true;
        break;
      case Event::kRelease:
        pressed = false;
        break;
      case Event::kWait:
        break;
      default:
        armed = false;
    }
    if (!armed) pressed = false;
  }
};

void apply(ArmedDrive& drive, Event event, double now) {
  switch (event) {
    case Event::kMotors:
      return drive.observe(now, kInside);
    case Event::kMotorsOutside:
      return drive.observe(now, kOutside);
    case Event::kArm:
      drive.arm(now);
      return;
    case Event::kDisarm:
      return drive.disarm();
    case Event::kHold:
      return drive.hold(now);
    case Event::kRelease:
      return drive.release();
    case Event::kByHand:
      return drive.stop(DriveStop::kByHand);
    case Event::kFocus:
      return drive.stop(DriveStop::kFocus);
    case Event::kWait:
      return;
  }
}

/// All sequences of six events after a beginning, with a step after each event.
TEST(ArmedDrive, SendsOnlyWhileArmedAndHeldInEverySequenceOfEvents) {
  constexpr int kLength = 6;
  std::size_t sent = 0, sequences = 0;
  const std::vector<std::vector<Event>> beginnings = {
      {},
      {Event::kMotors, Event::kArm},
      {Event::kMotors, Event::kArm, Event::kHold},
  };
  for (const auto& beginning : beginnings)
    for (int code = 0; code < static_cast<int>(std::pow(kEvents, kLength)); ++code) {
      ArmedDrive drive(raven(), kSpeed);
      Oracle oracle;
      double now = 100.0;
      ++sequences;
      const auto happens = [&](Event event) {
        apply(drive, event, now);
        oracle.take(event, now);
        now += event == Event::kWait ? kPause : kPeriod;
        const bool sends = drive.step(now).has_value();
        oracle.judge(now);
        sent += sends;
        ASSERT_EQ(sends, oracle.pressed) << "sequence " << code;
        ASSERT_EQ(drive.state() == DriveState::kMoving, oracle.pressed) << code;
        ASSERT_EQ(drive.state() == DriveState::kArmed, oracle.armed && !oracle.pressed) << code;
      };
      for (const Event event : beginning) happens(event);
      for (int k = 0, rest = code; k < kLength; ++k, rest /= kEvents)
        happens(static_cast<Event>(rest % kEvents));
      if (HasFatalFailure()) return;
    }
  EXPECT_GT(sent, sequences / 10) << "a drive that never sends passes every test";
}

/// Every cause stops from armed and from moving, at once and until the drive is armed again.
TEST(ArmedDrive, AStopHoldsUntilItIsArmedAgain) {
  for (const auto& [cause, words] : base::NamesOf<DriveStop>::value)
    for (const bool moving : {false, true}) {
      if (cause == DriveStop::kNone) continue;
      ArmedDrive drive(raven(), kSpeed);
      drive.observe(1.0, kInside);
      ASSERT_TRUE(drive.arm(1.0));
      if (moving) drive.hold(1.0);
      ASSERT_EQ(drive.step(1.01).has_value(), moving);
      drive.stop(cause);
      EXPECT_EQ(drive.state(), DriveState::kStopped);
      EXPECT_EQ(drive.reason(), words);
      drive.stop(DriveStop::kFocus);
      EXPECT_EQ(drive.cause(), cause) << "the first one is the reason";
      for (double now = 1.02; now < 1.1; now += 0.01) {
        drive.observe(now, kInside);
        drive.hold(now);
        EXPECT_FALSE(drive.step(now));
      }
      EXPECT_TRUE(drive.arm(1.1));
      EXPECT_FALSE(drive.step(1.1)) << "armed, and the key is not held";
      drive.hold(1.1);
      EXPECT_TRUE(drive.step(1.11));
    }
}

TEST(ArmedDrive, IsArmedOnlyWithMotorsInsideTheLimits) {
  ArmedDrive drive(raven(), kSpeed);
  EXPECT_FALSE(drive.arm(1.0));
  EXPECT_EQ(drive.cause(), DriveStop::kSilent);
  drive.observe(1.0, kOutside);
  EXPECT_FALSE(drive.arm(1.0));
  EXPECT_EQ(drive.cause(), DriveStop::kOutside);
  drive.observe(1.0, {0.5, std::numeric_limits<double>::quiet_NaN(), 0.4});
  EXPECT_FALSE(drive.arm(1.0));
  drive.observe(1.0, kInside);
  EXPECT_FALSE(drive.arm(1.0 + 1.1 * ArmedDrive::kSilence));
  EXPECT_TRUE(drive.arm(1.0));
  EXPECT_EQ(drive.reason(), "");
}

/// A robot that follows its set-points with a lag, sampled at 1 kHz and commanded at 100 Hz.
struct Arm {
  Eigen::Vector3d q;
  double lag = 0.02;
  std::function<void(Eigen::Vector3d&)> obstacle = [](Eigen::Vector3d&) {};

  /// The set-points of a drive with the key held, until it ends or `seconds` have passed.
  std::vector<Eigen::Vector3d> run(ArmedDrive& drive, double seconds) {
    std::vector<Eigen::Vector3d> points;
    std::optional<Eigen::Vector3d> command;
    drive.observe(0.0, q);
    if (!drive.arm(0.0)) return points;
    for (int k = 1; k < 1000 * seconds && drive.state() != DriveState::kStopped; ++k) {
      const double now = 1e-3 * k;
      if (command) q += 1e-3 / lag * (*command - q);
      obstacle(q);
      drive.observe(now, q);
      drive.hold(now);
      if (k % 10 != 0) continue;
      command = drive.step(now);
      if (command) points.push_back(*command);
    }
    return points;
  }
};

TEST(ArmedDrive, DrivesToTheHardStopWithinSpeedsAndLimits) {
  for (const Eigen::Vector3d& start : {kInside, Eigen::Vector3d(1.5, 0.8, 0.24),
                                       Eigen::Vector3d(0.0, 2.3, 0.56), Eigen::Vector3d(-0.05, 1.0, 0.5)}) {
    ArmedDrive drive(raven(), kSpeed);
    Arm arm{start};
    const auto points = arm.run(drive, 60.0);
    EXPECT_EQ(drive.cause(), DriveStop::kArrived) << drive.reason();
    ASSERT_FALSE(points.empty());
    EXPECT_LT((points.back() - kStop).norm(), 1e-12);
    EXPECT_LT((arm.q - kStop).norm(), 1e-3);
    Eigen::Vector3d before = start;
    for (const Eigen::Vector3d& point : points) {
      for (int k = 0; k < 3; ++k) {
        const double speed = kSpeed[static_cast<std::size_t>(k)];
        ASSERT_LE(std::abs(point[k] - before[k]), speed * 0.01 * (1.0 + 1e-9)) << "joint " << k + 1;
        ASSERT_LE(std::abs(point[k] - kStop[k]), std::abs(before[k] - kStop[k]) + 1e-12) << "away from it";
        ASSERT_GE(point[k], std::min(start[k], drive.lowest()[k]) - 1e-12);
        ASSERT_LE(point[k], std::max(start[k], drive.highest()[k]) + 1e-12);
      }
      before = point;
    }
  }
}

TEST(ArmedDrive, NeverExceedsTheRobotsOwnSpeed) {
  const ArmedDrive drive(raven(), {10.0, 10.0, 10.0});
  EXPECT_EQ(drive.speed(), Eigen::Vector3d(3.0, 3.0, 0.15)) << "max_speed of the robot file";
}

/// A joint that meets a hand: the set-point waits beside it, and after a second the drive stops.
TEST(ArmedDrive, StopsWhereTheArmDoesNotFollow) {
  ArmedDrive drive(raven(), kSpeed);
  Arm arm{kInside};
  arm.obstacle = [](Eigen::Vector3d& q) { q[0] = std::max(q[0], 0.5); };
  const auto points = arm.run(drive, 60.0);
  EXPECT_EQ(drive.cause(), DriveStop::kStuck);
  EXPECT_GT(points.back()[0], 0.5 - ArmedDrive::kLead * kSpeed[0] - 1e-9);
}

/// A program that hangs while the key is down renews it no more.
TEST(ArmedDrive, AKeyThatIsNotRenewedCountsAsReleased) {
  ArmedDrive drive(raven(), kSpeed);
  drive.observe(0.0, kInside);
  ASSERT_TRUE(drive.arm(0.0));
  drive.hold(0.0);
  double last = 0.0;
  for (int k = 1; k < 100; ++k) {
    drive.observe(0.01 * k, kInside);
    if (drive.step(0.01 * k)) last = 0.01 * k;
  }
  EXPECT_GT(last, 0.1);
  EXPECT_LE(last, ArmedDrive::kHold + 1e-9);
  EXPECT_EQ(drive.state(), DriveState::kArmed);
}

TEST(ArmedDrive, ALateStepMovesNoFurtherThanTheLongest) {
  ArmedDrive drive(raven(), kSpeed);
  drive.observe(0.0, kInside);
  ASSERT_TRUE(drive.arm(0.0));
  Eigen::Vector3d before = kInside;
  for (double now = 0.0; now < 3.0; now += 0.09) {  // a computer that is far too slow
    drive.observe(now, before);
    drive.hold(now);
    if (const auto point = drive.step(now)) {
      for (int k = 0; k < 3; ++k)
        ASSERT_LE(std::abs((*point)[k] - before[k]),
                  kSpeed[static_cast<std::size_t>(k)] * ArmedDrive::kLongestStep * (1.0 + 1e-9));
      before = *point;
    }
  }
  EXPECT_GT((before - kInside).norm(), 0.01);
}

/// After a release and a new press it goes on from where the arm is.
TEST(ArmedDrive, GoesOnFromTheMeasuredPositions) {
  ArmedDrive drive(raven(), kSpeed);
  drive.observe(0.0, kInside);
  ASSERT_TRUE(drive.arm(0.0));
  drive.hold(0.0);
  ASSERT_TRUE(drive.step(0.01));
  drive.release();
  EXPECT_FALSE(drive.step(0.02));
  const Eigen::Vector3d moved = kInside + Eigen::Vector3d(0.3, -0.2, 0.05);
  drive.observe(0.03, moved);
  drive.hold(0.03);
  const auto point = drive.step(0.04);
  ASSERT_TRUE(point);
  EXPECT_LT((*point - moved).norm(), 0.01);
}

}  // namespace
}  // namespace capstan::live
