#include "core/identification/live_recording.h"

#include <fmt/format.h>

#include "core/base/yaml.h"

namespace capstan::identification {
namespace {

constexpr double kPatience = 2.0;           // time without a camera before this is reported [s]
constexpr std::size_t kReserve = 1U << 14;  // expected motor samples between two calls of data()

bool same(const std::optional<Eigen::Isometry3d>& a, const std::optional<Eigen::Isometry3d>& b) {
  return a.has_value() == b.has_value() && (!a || a->matrix() == b->matrix());
}

}  // namespace

std::string wordsOf(const LiveExtent& extent) {
  if (extent.motor_failed && extent.motors == 0)
    return "A motor encoder has failed. Nothing can be identified without it.";
  if (extent.motors == 0) return "Waiting for the motors of the arm.";
  if (!extent.registered) return "The cameras are not registered. Register them first (Ctrl+R).";
  if (extent.observations == 0 && extent.seconds < kPatience) return "Waiting for the cameras.";
  if (extent.cameras == 0) return "This session has no cameras. Nothing can be identified without them.";
  if (extent.observations == 0)
    return "The cameras do not detect the marker. Nothing can be identified without it.";
  const auto text =
      fmt::format("{:.0f} s collected; the tip was observed {} times.", extent.seconds, extent.observations);
  if (extent.motor_failed) return text + " A motor encoder has failed, so the collection has ended.";
  return extent.full ? text + " This is the longest collection, so it has ended." : text;
}

LiveRecording::LiveRecording(std::string title, double longest)
    : title_(std::move(title)), longest_(longest) {
  motors_.reserve(kReserve);
}

void LiveRecording::begin(const tracking::TrackingPipeline& pipeline) {
  const std::string robot = base::writeYaml(pipeline.robot());
  const std::lock_guard lock(mutex_);
  if (blank_ && robot == robot_ && same(registration_, pipeline.registration())) return;
  robot_ = robot;
  registration_ = pipeline.registration();
  blank_.emplace(pipeline, title_);
  restart();
}

void LiveRecording::restart() {
  motors_.clear();
  cameras_.clear();
  const std::uint64_t restarts = extent_.motors > 0 ? extent_.restarts + 1 : extent_.restarts;
  extent_ = {};
  extent_.restarts = restarts;
  failed_ = {};
  restarted_ = true;
}

void LiveRecording::takeMotors(const tracking::Snapshot& snapshot) {
  if (extent_.motors > 0 && snapshot.t <= last_) restart();
  const bool news = snapshot.motor_failed != failed_;
  failed_ = snapshot.motor_failed;
  extent_.motor_failed = tracking::anyMotorFailed(snapshot);
  const bool known = motorsKnown(snapshot);
  if (known && extent_.motors == 0) first_ = snapshot.t;
  extent_.full = extent_.motors > 0 && snapshot.t - first_ > longest_;
  if (extent_.full || !(known || news)) return;
  motors_.push_back({snapshot.t, snapshot.q_motor, snapshot.dq_motor, snapshot.motor_failed});
  if (!known) return;  // the collector needs the failure only
  last_ = snapshot.t;
  ++extent_.motors;
  extent_.seconds = last_ - first_;
}

void LiveRecording::take(const tracking::Sample&, const tracking::Snapshot& snapshot) {
  const std::lock_guard lock(mutex_);
  if (snapshot.motor_updated) takeMotors(snapshot);
  if (!snapshot.camera_updated || extent_.full || extent_.motor_failed) return;
  ++extent_.cameras;
  extent_.registered = snapshot.gate != tracking::Gate::kUnregistered;
  if (!snapshot.tip_cam.allFinite() || !snapshot.q_link_cam.allFinite()) return;
  ++extent_.observations;
  cameras_.push_back(snapshot);
}

LiveExtent LiveRecording::extent() const {
  const std::lock_guard lock(mutex_);
  return extent_;
}

void LiveRecording::feed(const std::vector<Motor>& motors, const std::vector<tracking::Snapshot>& cameras) {
  tracking::Snapshot snapshot;
  snapshot.q_link_kin.setZero();  // finite: samples without it were not taken, unless an encoder failed
  for (const Motor& motor : motors) {
    snapshot.t = motor.t;
    snapshot.q_motor = motor.position;
    snapshot.dq_motor = motor.velocity;
    snapshot.motor_failed = motor.failed;
    snapshot.motor_samples = ++fed_;
    collector_->add(tracking::MotorSample{motor.t, motor.position, motor.velocity, Eigen::Vector3d::Zero()},
                    snapshot);
  }
  for (const tracking::Snapshot& seen : cameras)
    collector_->add(tracking::TipSample{seen.t_cam, seen.t, seen.tip_cam}, seen);
}

IdentificationData LiveRecording::data() {
  std::vector<Motor> motors;
  motors.reserve(kReserve);
  std::vector<tracking::Snapshot> cameras;
  {
    const std::lock_guard lock(mutex_);
    motors.swap(motors_);
    cameras.swap(cameras_);
    if (restarted_) {
      collector_ = blank_;
      fed_ = 0;
    }
    restarted_ = false;
  }
  if (!collector_) return {};
  feed(motors, cameras);
  return DataCollector(*collector_).finish();
}

}  // namespace capstan::identification
