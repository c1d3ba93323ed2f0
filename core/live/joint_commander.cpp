#include "core/live/joint_commander.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/ros_topics.h"

namespace capstan::live {
namespace {

const robot::Description& checked(const robot::Description& robot) {
  if (robot.size() < 3)
    throw base::InputError({{},
                            0,
                            "commands",
                            fmt::format("{} joints", robot.size()),
                            "are too few for a drive to the hard stop",
                            "Leave commands out, or give the robot file of an arm with three joints"});
  return robot;
}

std::vector<std::string> namesOf(const CommandsSetup& setup, const robot::Description& robot) {
  if (!setup.names.empty()) return setup.names;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < 3; ++k) names.push_back(robot.joints[k].name);
  return names;
}

/// Places of the three joints in the robot's own message: by the names of the set-up, else its first three.
std::array<std::size_t, 3> placesOf(const CommandsSetup& setup, const std::vector<std::string>& names,
                                    const ros1::JointState& measured) {
  std::array<std::size_t, 3> places = {0, 1, 2};
  for (std::size_t k = 0; k < 3; ++k) {
    if (!setup.names.empty())
      places[k] =
          static_cast<std::size_t>(std::ranges::find(measured.name, names[k]) - measured.name.begin());
    if (places[k] >= measured.position.size())
      throw base::InputError(
          {"ros:" + setup.measured, 0, "commands.names", names[k],
           fmt::format("is not in the message, which has: {}", fmt::join(measured.name, ", ")),
           "Give three of these names"});
  }
  return places;
}

const std::string& topicOf(const CommandsSetup& setup) {
  return setup.servo_jp.empty() ? setup.move_jp : setup.servo_jp;
}

double toRobot(const CommandsSetup& setup, std::size_t joint, double q) {
  return setup.signs[joint] * q + setup.offsets[joint];
}

}  // namespace

ros1::JointState commandOf(const CommandsSetup& setup, const std::vector<std::string>& names,
                           const Eigen::Vector3d& point, const ros1::JointState* measured) {
  ros1::JointState command;
  std::array<std::size_t, 3> places = {0, 1, 2};
  if (measured) {
    command.name = measured->name, command.position = measured->position;
    places = placesOf(setup, names, *measured);
  } else {
    command.name = names, command.position.resize(3);
  }
  for (std::size_t k = 0; k < 3; ++k)
    command.position[places[k]] = toRobot(setup, k, point[static_cast<Eigen::Index>(k)]);
  return command;
}

std::string disagreementOf(const CommandsSetup& setup, const std::vector<std::string>& names,
                           const Eigen::Vector3d& q, const Eigen::Vector3d& tolerance,
                           const ros1::JointState& measured) {
  const std::array<std::size_t, 3> places = placesOf(setup, names, measured);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto joint = static_cast<Eigen::Index>(k);
    const double theirs = measured.position[places[k]], ours = toRobot(setup, k, q[joint]);
    if (!(std::abs(theirs - ours) <= tolerance[joint]))
      return fmt::format("{}: {:.4f} in {}, {:.4f} by the motors: check commands.signs and commands.offsets",
                         names[k], theirs, setup.measured, ours);
  }
  return {};
}

/// The topics of an armed drive.
class JointCommander::Topics {
 public:
  explicit Topics(const CommandsSetup& setup) : writer_(topicOf(setup), ros1::typeOf<ros1::JointState>()) {
    if (!setup.measured.empty()) reader_ = std::make_unique<ros1::TopicReader>(setup.measured, 1);
  }

  void publish(ros1::JointState command) {
    command.header.stamp = ros1::rosTimeNow();
    writer_.publish(ros1::encode(command));
  }
  bool hasSubscriber() const { return writer_.subscribers() > 0; }
  /// The robot's newest message; null: none within ArmedDrive::kSilence.
  const ros1::JointState* measured() {
    constexpr std::chrono::milliseconds kNow{0};
    while (const auto message = reader_ ? reader_->next(kNow) : std::nullopt) {
      measured_ = ros1::decode<ros1::JointState>(message->bytes);
      arrival_ = message->arrival;
    }
    const std::chrono::duration<double> age = Clock::now() - arrival_;
    return measured_ && age.count() <= ArmedDrive::kSilence ? &*measured_ : nullptr;
  }

  /// The robot's message when the key was pressed: what the other joints are held at.
  std::optional<ros1::JointState> held;

 private:
  ros1::TopicWriter writer_;
  std::unique_ptr<ros1::TopicReader> reader_;
  std::optional<ros1::JointState> measured_;
  Clock::time_point arrival_;  ///< of measured_
};

JointCommander::JointCommander(const CommandsSetup& setup, const robot::Description& robot)
    : setup_(setup),
      joints_(namesOf(setup, checked(robot))),
      drive_(robot, setup.speed),
      thread_([this] { work(); }) {}

JointCommander::~JointCommander() {
  {
    const std::lock_guard lock(mutex_);
    drive_.stop(DriveStop::kEnded);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void JointCommander::observe(const Eigen::Vector3d& q, Clock::time_point arrival) {
  const std::lock_guard lock(mutex_);
  drive_.observe(timeOf(arrival), q);
}

void JointCommander::arm() {
  {
    const std::lock_guard lock(mutex_);
    if (drive_.state() == DriveState::kArmed || drive_.state() == DriveState::kMoving) return;
    wants_arming_ = true;
    detail_.clear();
  }
  changed_.notify_all();
}

void JointCommander::disarm() {
  {
    const std::lock_guard lock(mutex_);
    wants_arming_ = false;
    detail_.clear();
    drive_.disarm();
  }
  changed_.notify_all();
}

void JointCommander::hold() {
  const std::lock_guard lock(mutex_);
  drive_.hold(now());
}

void JointCommander::release() {
  const std::lock_guard lock(mutex_);
  drive_.release();
}

void JointCommander::stop(DriveStop cause) {
  const std::lock_guard lock(mutex_);
  wants_arming_ = false;
  drive_.stop(cause);
}

CommandStatus JointCommander::status() const {
  const std::lock_guard lock(mutex_);
  std::string reason = drive_.reason();
  if (!detail_.empty()) reason += ": " + detail_;
  return {drive_.state(), std::move(reason), topicOf(setup_), published_};
}

void JointCommander::fail(DriveStop cause, std::string what) {
  drive_.stop(cause);
  detail_ = std::move(what);
}

/// Opens the topics without the lock, since a master may be slow to answer.
void JointCommander::openTopics(std::unique_lock<std::mutex>& lock) {
  std::unique_ptr<Topics> opened;
  std::string fault;
  lock.unlock();
  try {
    opened = std::make_unique<Topics>(setup_);
  } catch (const std::exception& error) {
    fault = error.what();
  }
  lock.lock();
  const bool wanted = std::exchange(wants_arming_, false);
  if (!wanted || quit_ || !drive_.arm(now())) return;
  if (!opened) return fail(DriveStop::kNoTopic, fault);
  topics_ = std::move(opened);
}

void JointCommander::publish(const Eigen::Vector3d& point) {
  try {
    if (!topics_->hasSubscriber()) return fail(DriveStop::kNoTopic, "no robot listens to " + topicOf(setup_));
    const ros1::JointState* measured = topics_->measured();
    if (!setup_.measured.empty() && !topics_->held) {
      if (!measured) return fail(DriveStop::kDisagrees, "nothing comes from " + setup_.measured);
      const Eigen::Vector3d tolerance = ArmedDrive::kMargin * (drive_.highest() - drive_.lowest());
      if (std::string words = disagreementOf(setup_, joints_, drive_.measured(), tolerance, *measured);
          !words.empty())
        return fail(DriveStop::kDisagrees, std::move(words));
      topics_->held = *measured;
    }
    topics_->publish(commandOf(setup_, joints_, point, topics_->held ? &*topics_->held : nullptr));
    ++published_;
  } catch (const std::exception& error) {
    fail(DriveStop::kNoTopic, error.what());
  }
}

void JointCommander::work() {
  const auto period = setup_.servo_jp.empty() ? kMovePeriod : kServoPeriod;
  std::unique_lock lock(mutex_);
  for (Clock::time_point due = Clock::now(); !quit_;) {
    const bool idle = drive_.state() == DriveState::kDisarmed || drive_.state() == DriveState::kStopped;
    if (idle && topics_) {
      std::unique_ptr<Topics> closing = std::move(topics_);
      lock.unlock();  // ~Topics() waits for ROS
      closing.reset();
      lock.lock();
      continue;
    }
    if (wants_arming_) {
      openTopics(lock);
      due = Clock::now();
      continue;
    }
    if (idle) {
      changed_.wait(lock);
      continue;
    }
    const auto point = drive_.step(now());
    if (point)
      publish(*point);
    else
      topics_->held.reset();
    due = std::max(due + period, Clock::now());
    changed_.wait_until(lock, due, [this] { return quit_; });
  }
}

}  // namespace capstan::live
