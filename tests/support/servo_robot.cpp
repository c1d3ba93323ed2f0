/// servo_robot LOG: a robot of the RAVEN-II's kind as a ROS node, for tests of commands. It publishes its
/// motors
/// (/arm/actuators/measured_js) and all six of its joints (/arm/measured_js) every millisecond, follows the
/// set-points of /arm/servo_jp with a lag, and goes to the goals of /arm/move_jp at a speed of its own. Its
/// joints count otherwise than the robot file's: q_robot = sign q + offset. Every command that arrives
/// becomes a line of LOG: time of the monotonic clock [s], then the positions.
#include <sys/prctl.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "core/robot/transmission.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/ros_topics.h"
#include "tests/support/servo_robot.h"

namespace {

using namespace capstan;
using Clock = std::chrono::steady_clock;

class ServoRobot {
 public:
  explicit ServoRobot(const char* log)
      : log_(std::fopen(log, "w")), transmission_(robot::defaultDescription()) {}
  ~ServoRobot() { std::fclose(log_); }

  [[noreturn]] void run() {
    constexpr std::chrono::milliseconds kNow{0}, kPeriod{1};
    for (Clock::time_point due = Clock::now();; std::this_thread::sleep_until(due += kPeriod)) {
      while (const auto message = set_points_.next(kNow))
        if (obey(*message)) commanded_ = goal_;
      while (const auto message = goals_.next(kNow)) obey(*message);
      const Eigen::Vector3d reach = kPeriod.count() * 1e-3 * kSpeed;
      commanded_ += (goal_ - commanded_).cwiseMax(-reach).cwiseMin(reach);
      q_ += kPeriod.count() * 1e-3 / kLag * (commanded_ - q_);
      publish();
    }
  }

 private:
  static constexpr double kLag = 0.02;                         // [s]
  inline static const Eigen::Vector3d kSpeed{0.5, 0.5, 0.05};  // towards a goal [rad/s, m/s]

  /// Takes the goal of a message; false: it has another number of joints.
  bool obey(const ros1::TopicMessage& message) {
    const auto command = ros1::decode<ros1::JointState>(message.bytes);
    std::fprintf(log_, "%.6f", std::chrono::duration<double>(message.arrival.time_since_epoch()).count());
    for (const double position : command.position) std::fprintf(log_, " %.9f", position);
    std::fprintf(log_, "\n");
    std::fflush(log_);
    if (command.position.size() != testing::kServoNames.size()) return false;
    for (int k = 0; k < 3; ++k) {
      const auto joint = static_cast<std::size_t>(k);
      goal_[k] = (command.position[testing::kServoPlaces[joint]] - testing::kServoOffsets[joint]) /
                 testing::kServoSigns[joint];
    }
    return true;
  }

  void publish() {
    const ros1::MessageHeader header{ros1::rosTimeNow(), ""};
    const robot::JointVector q_m = transmission_.motorFromJoint(q_);
    motors_.publish(ros1::encode(
        ros1::JointState{header, {"motor_1", "motor_2", "motor_3"}, {q_m[0], q_m[1], q_m[2]}, {}, {}}));
    ros1::JointState joints{header, {testing::kServoNames.begin(), testing::kServoNames.end()}, {}, {}, {}};
    joints.position = {testing::kServoWrist[0], 0.0, testing::kServoWrist[1], 0.0, 0.0,
                       testing::kServoWrist[2]};
    for (int k = 0; k < 3; ++k) {
      const auto joint = static_cast<std::size_t>(k);
      joints.position[testing::kServoPlaces[joint]] =
          testing::kServoSigns[joint] * q_[k] + testing::kServoOffsets[joint];
    }
    joints_.publish(ros1::encode(joints));
  }

  std::FILE* const log_;
  const robot::Transmission transmission_;
  Eigen::Vector3d q_ = testing::kServoStart, commanded_ = q_, goal_ = q_;
  ros1::TopicReader set_points_{"/arm/servo_jp", 1000}, goals_{"/arm/move_jp", 1000};
  ros1::TopicWriter motors_{"/arm/actuators/measured_js", ros1::typeOf<ros1::JointState>()};
  ros1::TopicWriter joints_{"/arm/measured_js", ros1::typeOf<ros1::JointState>()};
};

}  // namespace

int main(int argc, char** argv) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (argc != 2) return 2;
  ServoRobot(argv[1]).run();
}
