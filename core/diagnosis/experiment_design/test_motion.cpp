#include "core/diagnosis/experiment_design/test_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/robot/transmission.h"
#include "core/simulation/trajectory.h"

namespace capstan::diagnosis {
namespace {

using robot::JointVector;

constexpr double kWiden = 0.25;       // of the visited range, at either end
constexpr double kFromLimit = 0.05;   // of the range between the joint limits
constexpr double kSpeedShare = 0.5;   // of a joint's highest speed
constexpr double kPeakSpeed = 1.875;  // of a minimum-jerk motion, in mean speeds

/// Range of each joint in which the motions stay, and the highest speed.
struct Room {
  JointVector low, high, speed;

  JointVector centre() const { return 0.5 * (low + high); }
};

/// Lowest and highest joint positions that the recordings visited.
std::pair<JointVector, JointVector> visited(const robot::Description& robot,
                                            const std::vector<Evidence>& recordings) {
  const robot::Transmission transmission(robot);
  const int joints = robot.size();
  JointVector low = JointVector::Constant(joints, std::numeric_limits<double>::infinity()), high = -low;
  for (const Evidence& evidence : recordings)
    for (std::size_t row = 0; row < evidence.rows(); ++row) {
      JointVector q_m(joints);
      for (int j = 0; j < joints; ++j) q_m[j] = evidence.q_m[static_cast<std::size_t>(j)][row];
      const JointVector q = transmission.jointFromMotor(q_m);
      if (!q.allFinite()) continue;
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
  return {low, high};
}

Room roomOf(const robot::Description& robot, const std::vector<Evidence>& recordings) {
  auto [low, high] = visited(robot, recordings);
  Room room{low, high, JointVector(robot.size())};
  for (int j = 0; j < robot.size(); ++j) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(j)];
    const double inside = kFromLimit * (joint.limit_high - joint.limit_low),
                 wider = kWiden * (high[j] - low[j]);
    const double bottom = joint.limit_low + inside, top = joint.limit_high - inside;
    room.low[j] = std::clamp(low[j] - wider, bottom, top);
    room.high[j] = std::clamp(high[j] + wider, bottom, top);
    room.speed[j] = kSpeedShare * joint.max_speed;
  }
  return room;
}

/// Path of one joint through positions, each reached by a minimum-jerk motion and followed by a rest.
class Path {
 public:
  Path(double start, double speed) : end_(start), speed_(speed) {}

  /// Moves to `q` in `duration` [s], or slower where the speed would be too high; then rests.
  void to(double q, double duration, double rest = 0.0) {
    duration = std::max({duration, kPeakSpeed * std::abs(q - end_) / speed_, kShortest});
    pieces_.push_back({length_, duration, end_, q});
    length_ += duration + rest;
    end_ = q;
  }
  double length() const { return length_; }
  double end() const { return end_; }

  /// Position and velocity at t.
  std::pair<double, double> at(double t) const {
    std::pair<double, double> now{pieces_.empty() ? end_ : pieces_.front().from, 0.0};
    for (const Piece& piece : pieces_) {
      if (t < piece.begin) break;
      const auto [progress, rate] = simulation::minimumJerk(t - piece.begin, piece.duration);
      now = {piece.from + progress * (piece.to - piece.from), rate * (piece.to - piece.from)};
    }
    return now;
  }

 private:
  static constexpr double kShortest = 0.2;  // [s]
  struct Piece {
    double begin, duration, from, to;
  };
  std::vector<Piece> pieces_;
  double length_ = 0.0, end_, speed_;
};

TestMotion motionOf(std::string title, const std::vector<Path>& paths, double step) {
  TestMotion motion{std::move(title), step, {}, {}};
  double length = 0.0;
  for (const Path& path : paths) length = std::max(length, path.length());
  const auto samples = static_cast<std::size_t>(std::ceil(length / step)) + 1;
  for (std::size_t k = 0; k < samples; ++k) {
    JointVector q(static_cast<Eigen::Index>(paths.size())), dq(q.size());
    for (std::size_t j = 0; j < paths.size(); ++j)
      std::tie(q[static_cast<Eigen::Index>(j)], dq[static_cast<Eigen::Index>(j)]) =
          paths[j].at(step * static_cast<double>(k));
    motion.q.push_back(std::move(q));
    motion.dq.push_back(std::move(dq));
  }
  return motion;
}

class Family {
 public:
  Family(const Room& room, double step) : room_(room), step_(step) {}

  std::vector<TestMotion> motions() {
    const int joints = static_cast<int>(room_.low.size());
    for (int j = 0; j < joints; ++j) {
      add(j, "sweeps slowly", [&](Path& path) { sweep(path, j, kTestDuration / 4.0); });
      add(j, "sweeps fast", [&](Path& path) { sweep(path, j, 0.0); });
      add(j, "moves in steps with rests", [&](Path& path) { steps(path, j); });
      add(j, "makes small reversals", [&](Path& path) { reversals(path, j); });
    }
    addTogether("all joints move at once", kTestDuration);
    addTogether("all joints move fast, then rest", kTestDuration / 3.0);
    return std::move(motions_);
  }

 private:
  std::vector<Path> atRest() const {
    std::vector<Path> paths;
    for (Eigen::Index j = 0; j < room_.low.size(); ++j) paths.emplace_back(room_.centre()[j], room_.speed[j]);
    return paths;
  }

  template <class Move>
  void add(int joint, const char* does, const Move& move) {
    std::vector<Path> paths = atRest();
    Path& path = paths[static_cast<std::size_t>(joint)];
    move(path);
    path.to(room_.centre()[joint], 1.0);
    const bool alone = paths.size() == 1;
    motions_.push_back(motionOf(
        fmt::format("joint {} {}{}", joint + 1, does, alone ? "" : ", the other joints rest"), paths, step_));
  }

  /// Back and forth over the whole range for kTestDuration; each way takes `duration` or as long as it must.
  void sweep(Path& path, int j, double duration) const {
    path.to(room_.low[j], 0.5 * duration);
    for (bool up = true; path.length() + 0.5 * duration < kTestDuration - kReturn; up = !up)
      path.to(up ? room_.high[j] : room_.low[j], duration);
  }

  /// Five levels upwards and downwards with rests.
  void steps(Path& path, int j) const {
    constexpr int kLevels = 5;
    constexpr double kRest = 1.2;
    for (int k = 0; k < 2 * kLevels - 1; ++k) {
      const int level = k < kLevels ? k : 2 * (kLevels - 1) - k;
      path.to(room_.low[j] + (room_.high[j] - room_.low[j]) * level / (kLevels - 1), 1.0, kRest);
    }
  }

  /// At three levels, reversals of decreasing width.
  void reversals(Path& path, int j) const {
    for (const double level : {0.25, 0.5, 0.75})
      for (const double width : {0.1, -0.1, 0.05, -0.05, 0.02, -0.02})
        path.to(room_.low[j] + (room_.high[j] - room_.low[j]) * (level + width), 1.0, 0.2);
  }

  /// Each joint sweeps its range for `moving` seconds, each at a pace of its own; the rest of the time it
  /// rests.
  void addTogether(const char* title, double moving) {
    constexpr double kPace[] = {1.0, 0.79, 0.61, 0.47, 0.37, 0.29, 0.23};  // share of the highest speed
    std::vector<Path> paths = atRest();
    for (std::size_t j = 0; j < paths.size(); ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      const double way = room_.high[at] - room_.low[at];
      const double duration = kPeakSpeed * way / (room_.speed[at] * kPace[j]);
      paths[j].to(room_.low[at], 0.5 * duration);
      for (bool up = true; paths[j].length() + 1.5 * duration < moving; up = !up)
        paths[j].to(up ? room_.high[at] : room_.low[at], duration);
      paths[j].to(room_.centre()[at], 0.5 * duration);
      paths[j].to(room_.centre()[at], std::max(0.0, kTestDuration - paths[j].length()));
    }
    motions_.push_back(motionOf(title, paths, step_));
  }

  static constexpr double kReturn = 2.0;  // kept for the way back to the centre [s]
  const Room& room_;
  double step_;
  std::vector<TestMotion> motions_;
};

}  // namespace

std::vector<TestMotion> testMotions(const robot::Description& robot, const std::vector<Evidence>& recordings,
                                    double step) {
  const Room room = roomOf(robot, recordings);
  return Family(room, step).motions();
}

}  // namespace capstan::diagnosis
