#include "core/live/monitor_feed.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/base/error.h"
#include "core/live/arm_overlay.h"
#include "core/live/recent_estimates.h"
#include "core/live/tip_ellipse.h"

namespace capstan::live {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kImagePeriod = std::chrono::milliseconds(10);    // least time between images of a fast run
constexpr auto kStatePeriod = std::chrono::milliseconds(50);    // of states without images
constexpr auto kImageSilence = std::chrono::milliseconds(500);  // then states come without images

FeedTracking trackingOf(tracking::Gate gate) {
  using tracking::Gate;
  switch (gate) {
    case Gate::kOpen:
      return FeedTracking::kTracking;
    case Gate::kNoCamera:
      return FeedTracking::kNoCamera;
    case Gate::kUnregistered:
      return FeedTracking::kUnregistered;
    case Gate::kUnreachable:
    case Gate::kJump:
    case Gate::kExchanged:
    case Gate::kLate:
      return FeedTracking::kRejected;
    default:
      return FeedTracking::kOccluded;
  }
}

std::string wordsOf(const tracking::Snapshot& s) {
  std::string words;
  for (std::size_t motor = 0; motor < 3; ++motor)
    if (s.motor_failed[motor] != tracking::MotorFault::kNone)
      words += "motor " + std::to_string(motor + 1) + " encoder " +
               std::string(base::nameOf(s.motor_failed[motor])) + ", ";
  if (s.gate == tracking::Gate::kOpen) return words.substr(0, words.empty() ? 0 : words.size() - 2);
  return words + std::string(tracking::gateWords(s));
}

void copyTo(std::array<double, 3>& to, const Eigen::Vector3d& from) {
  for (int i = 0; i < 3; ++i) to[static_cast<std::size_t>(i)] = from[i];
}

}  // namespace

/// The writer, and which session may use it. A session that was left may still run for some samples.
class MonitorFeed::Shared {
 public:
  explicit Shared(const std::string& name) : name_(name), writer_(std::make_unique<FeedWriter>(name)) {}

  const std::string& name() const { return name_; }
  std::uint64_t begin() {
    const std::lock_guard lock(mutex_);
    return ++session_;
  }
  void close() {
    const std::lock_guard lock(mutex_);
    writer_.reset();
  }
  void publish(std::uint64_t session, auto&&... what) {
    const std::lock_guard lock(mutex_);
    if (writer_ && session == session_) writer_->publish(what...);
  }
  void setRun(FeedRun run) {
    const std::lock_guard lock(mutex_);
    if (writer_) writer_->setRun(run);
  }

 private:
  const std::string name_;
  std::mutex mutex_;
  std::unique_ptr<FeedWriter> writer_;
  std::uint64_t session_ = 0;
};

/// One session; used by its pipeline's thread.
class MonitorFeed::Session {
 public:
  Session(std::shared_ptr<Shared> shared, const tracking::SourceInfo& info)
      : shared_(std::move(shared)), number_(shared_->begin()) {
    state_.session = number_;
    setText(state_.title, info.title);
    for (std::size_t i = 0; i < 3 && i < info.robot.joints.size(); ++i)
      setText(state_.joints[i], info.robot.joints[i].name);
  }

  void begin(const tracking::TrackingPipeline& pipeline) {
    arm_.emplace(pipeline.robot());
    marker_radius_ = pipeline.robot().marker_radius;
    rig_ = pipeline.rig();
    base_from_camera_ = pipeline.registration();
  }

  void take(const tracking::Sample& sample, const tracking::Snapshot& s) {
    if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample)) return takeFrame(*frame, s);
    if (!s.motor_updated) return;
    estimates_.add(s);
    const auto now = Clock::now();
    if (now - published_ < kStatePeriod || now - images_ < kImageSilence) return;
    published_ = now;
    describe(s, estimates_.newest());
    shared_->publish(number_, state_);
  }

 private:
  void takeFrame(const tracking::StereoFrame& frame, const tracking::Snapshot& s) {
    const auto now = Clock::now();
    if (now - images_ < kImagePeriod) return;
    images_ = published_ = now;
    state_.t_cam = frame.t;
    describe(s, estimates_.at(frame.t));
    shared_->publish(number_, state_, frame.left, frame.right);
  }

  void describe(const tracking::Snapshot& s, const RecentEstimates::Estimate* drawn) {
    state_.t = s.t;
    state_.tracking = trackingOf(s.gate);
    if (state_.tracking == FeedTracking::kTracking) certain_ = s.t;
    state_.uncertain_for = std::isfinite(s.t - certain_) ? std::max(s.t - certain_, 0.0) : 0.0;
    state_.motor_fault = tracking::anyMotorFailed(s) ? 1 : 0;
    setText(state_.words, wordsOf(s));
    copyTo(state_.q, s.q_link_ukf);
    copyTo(state_.q_sigma, s.q_link_ukf_sigma);
    copyTo(state_.tip, s.tip_ukf);
    copyTo(state_.tip_sigma, s.tip_ukf_covariance.diagonal().cwiseMax(0.0).cwiseSqrt());
    for (std::size_t side = 0; side < 2; ++side) {
      const vision::MarkerDetection& marker = s.marker[side];
      FeedEye& eye = state_.eyes[side];
      eye.marker_found = marker.found() ? 1 : 0;
      eye.circle = {marker.centroid.x(), marker.centroid.y(), marker.radius};
      eye.tip_found = eye.shaft_points = 0;
    }
    if (drawn && arm_ && rig_ && base_from_camera_) project(*drawn);
  }

  void project(const RecentEstimates::Estimate& estimate) {
    const ArmOverlay overlay = projectArm(*arm_, marker_radius_, *rig_, *base_from_camera_, estimate.q);
    const Eigen::Isometry3d left_from_base = base_from_camera_->inverse();
    for (std::size_t side = 0; side < 2; ++side) {
      const ArmOverlay::Side& seen = overlay.sides[side];
      FeedEye& eye = state_.eyes[side];
      const std::size_t points = std::min(seen.shaft.size(), eye.shaft.size());  // those next to the marker
      for (std::size_t i = 0; i < points; ++i) {
        const Eigen::Vector2d& point = seen.shaft[seen.shaft.size() - points + i];
        eye.shaft[i] = {point.x(), point.y()};
      }
      eye.shaft_points = static_cast<std::int32_t>(points);
      if (!seen.marker) continue;
      eye.tip_found = 1;
      eye.tip = {seen.marker->x(), seen.marker->y(), seen.marker_radius};
      const auto ellipse = tipEllipse(side == 0 ? rig_->left : rig_->right,
                                      side == 0 ? left_from_base : rig_->right_from_left * left_from_base,
                                      estimate.tip, estimate.tip_covariance);
      eye.ellipse =
          ellipse ? std::array{ellipse->major, ellipse->minor, ellipse->angle} : std::array<double, 3>{};
    }
  }

  const std::shared_ptr<Shared> shared_;
  const std::uint64_t number_;
  FeedState state_;
  std::optional<robot::ArmKinematics> arm_;
  double marker_radius_ = 0.0;
  std::optional<vision::StereoRig> rig_;
  std::optional<Eigen::Isometry3d> base_from_camera_;
  RecentEstimates estimates_;
  double certain_ = std::numeric_limits<double>::quiet_NaN();  ///< newest time with the gate open [s]
  Clock::time_point published_{}, images_{};
};

MonitorFeed::MonitorFeed(const std::string& name) : shared_(std::make_shared<Shared>(name)) {}

MonitorFeed::~MonitorFeed() { shared_->close(); }

const std::string& MonitorFeed::name() const { return shared_->name(); }

Listener MonitorFeed::begin(const tracking::SourceInfo& info) {
  const auto session = std::make_shared<Session>(shared_, info);
  setState(RunState::kRunning);
  return {
      [session](const tracking::TrackingPipeline& pipeline) { session->begin(pipeline); },
      [session](const tracking::Sample& sample, const tracking::Snapshot& s) { session->take(sample, s); }};
}

void MonitorFeed::setState(RunState state) {
  shared_->setRun(state == RunState::kPaused    ? FeedRun::kPaused
                  : state == RunState::kRunning ? FeedRun::kRunning
                                                : FeedRun::kEnded);
}

std::unique_ptr<MonitorFeed> makeMonitorFeed() {
  constexpr int kMost = 16;  // sessions at a time
  for (int number = 1;; ++number) {
    const std::string name = number == 1 ? kFeedName : kFeedName + ("-" + std::to_string(number));
    try {
      return std::make_unique<MonitorFeed>(name);
    } catch (const base::InputError&) {
      if (number == kMost) throw;
    }
  }
}

}  // namespace capstan::live
