#include "core/live/live_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "core/base/yaml.h"
#include "core/live/ros_rows.h"
#include "core/live/streams/address.h"
#include "core/live/text_rows.h"
#include "core/ros1/receive_rig.h"
#include "core/tracking/arrival.h"
#include "core/tracking/cover_frame.h"
#include "core/vision/marker_file.h"
#include "core/vision/registration_file.h"
#include "core/vision/rig_file.h"

namespace capstan::live {
namespace {

constexpr std::chrono::seconds kWaitForCalibration{5};
constexpr std::size_t kCapacity = 60000;  // samples: 20 s of 1 kHz with joint encoders and cameras

std::unique_ptr<RowInput> textRows(const Address& address, const std::string& read_as,
                                   const robot::Description& robot) {
  std::unique_ptr<ByteStream> stream = openByteStream(address);
  RowParser parser(stream->name(), robot, recording::parseReadAs(read_as, "motors.read_as"));
  return std::make_unique<TextRows>(std::move(stream), std::move(parser));
}

bool isPiped(const LiveSetup& setup) {
  return parseAddress(setup.motors.from, "motors.from").kind == Address::Kind::kStandardInput;
}

}  // namespace

LiveSource::LiveSource(const LiveSetup& setup, double duration)
    : LiveSource(setup, duration, isPiped(setup) ? RowSide::Faults::kEnd : RowSide::Faults::kDisconnect) {}

std::unique_ptr<LiveSource> LiveSource::forPreview(const LiveSetup& setup) {
  return std::unique_ptr<LiveSource>(new LiveSource(setup, 0.0, RowSide::Faults::kShow));
}

LiveSource::LiveSource(const LiveSetup& setup, double duration, RowSide::Faults faults)
    : queue_(kCapacity), duration_(duration) {
  if (setup.cameras) readCameras(*setup.cameras);
  const Address address = parseAddress(setup.motors.from, "motors.from");
  const bool piped = faults == RowSide::Faults::kEnd;
  info_.title = setup.title;
  info_.robot = robot::readDescriptionOrDefault(setup.robot);
  info_.reference = setup.motors.reference;
  info_.real_time = true;
  info_.sender_waits = piped;
  if (const std::vector<std::string> unused = fieldsNotUsed(setup.motors); !unused.empty())
    info_.notices.push_back(fmt::format("live set-up: not used for {}: motors.{}", setup.motors.from,
                                        fmt::join(unused, ", motors.")));
  std::unique_ptr<RowInput> input;
  // Messages of motors carry joints only where the robot has computed them from its motors.
  info_.own_kinematics =
      info_.reference && address.kind == Address::Kind::kRos && setup.motors.encoders.empty();
  if (address.kind == Address::Kind::kRos)
    input = std::make_unique<RosRows>(setup.motors, info_.robot);
  else
    input = textRows(address, setup.motors.read_as, info_.robot);
  // The units of messages are not the user's to state.
  const bool text = address.kind != Address::Kind::kRos;
  arrangement_.emplace(
      setup.motors, info_.robot,
      text ? recording::parseReadAs(setup.motors.read_as, "motors.read_as") : recording::ReadAs{});
  rows_ = std::make_unique<RowSide>(std::move(input), info_.robot, *arrangement_, setup.motors.reference,
                                    faults, queue_);
  if (setup.cameras)
    cameras_ = std::make_unique<CameraSide>(
        *setup.cameras,
        CameraSide::SessionClock{[this](CameraSide::Clock::time_point at) { return rows_->sessionTime(at); },
                                 [this](std::int64_t stamp) { return rows_->sessionTimeOfStamp(stamp); },
                                 [this] { return rows_->sessionBegin(); },
                                 [this] { return rows_->newestTime(); },
                                 [this] { return rows_->clockSteps(); }},
        queue_);
  if (setup.commands) {
    commander_ = std::make_shared<JointCommander>(*setup.commands, info_.robot);
    transmission_.emplace(info_.robot);
  }
  if (!piped) return;
  const RowFacts facts =
      rows_->waitForFirst(duration > 0.0 ? duration + std::chrono::duration<double>(kLateBegin).count()
                                         : std::numeric_limits<double>::infinity());
  info_.reference = facts.reference;
  info_.begin = facts.begin;
  info_.notices.insert(info_.notices.end(), facts.notices.begin(), facts.notices.end());
}

LiveSource::~LiveSource() {
  if (commander_) commander_->stop(DriveStop::kEnded);
}

void LiveSource::readCameras(const CamerasSetup& setup) {
  info_.rig = setup.calibration == kRosCalibration
                  ? ros1::receiveRig(rosTopicOf(setup.left), rosTopicOf(setup.right), kWaitForCalibration)
                  : vision::readRig(setup.calibration);
  if (!setup.marker.empty()) info_.marker = base::writeYaml(vision::readMarkerFile(setup.marker));
  if (!setup.registration.empty()) info_.base_from_camera = vision::readRegistration(setup.registration);
}

std::vector<tracking::SideStatus> LiveSource::sides() const {
  std::vector<tracking::SideStatus> sides{rows_->status()};
  sides.front().latency = motor_latency_.latency();
  if (!info_.sender_waits) sides.front().backlog = queue_.backlog();
  if (!cameras_) return sides;
  sides.push_back(cameras_->status());
  sides.back().latency = camera_latency_.latency();
  return sides;
}

/// Whoever asks for the next sample has the estimate of the one before.
void LiveSource::noteTracked() {
  if (!taken_) return;
  (taken_->camera ? camera_latency_ : motor_latency_).add(SampleQueue::Clock::now() - taken_->offered);
  taken_.reset();
}

bool LiveSource::ready(std::chrono::milliseconds wait) {
  noteTracked();
  return queue_.ready(wait) || timeIsUp();
}

bool LiveSource::timeIsUp() const {
  if (duration_ <= 0.0) return false;
  const std::chrono::duration<double> length(duration_);
  const std::chrono::seconds late = begin_ ? kLate : kLateBegin;
  return SampleQueue::Clock::now() - begun_at_ > length + late;
}

void LiveSource::discard() {
  taken_.reset();
  info_.sender_waits ? queue_.clearFrames() : queue_.clear();
}

bool LiveSource::next(tracking::Sample& out) {
  constexpr std::chrono::milliseconds kWait{50};
  while (!ready(kWait)) continue;
  if (!queue_.ready({}) && timeIsUp()) return false;
  const auto offered = queue_.take(out);
  if (!offered) {
    rows_->rethrow();
    return false;
  }
  taken_ = Taken{*offered, tracking::fromCamera(out)};
  const double t = tracking::arrivalOf(out);
  if (!begin_) begin_ = t, begun_at_ = SampleQueue::Clock::now();
  if (duration_ > 0.0 && t - *begin_ > duration_) return false;
  if (auto* motor = std::get_if<tracking::MotorSample>(&out)) {
    arrangement_->apply(*motor);
    if (commander_) commander_->observe(transmission_->jointFromMotor(motor->position), *offered);
  }
  if (auto* tip = std::get_if<tracking::TipSample>(&out); tip && (left_blocked_ || right_blocked_))
    tip->position.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (auto* frame = std::get_if<tracking::StereoFrame>(&out))
    tracking::coverFrame(*frame, {left_blocked_, right_blocked_});
  return true;
}

}  // namespace capstan::live
