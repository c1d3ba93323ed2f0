#include "core/live/estimate_topics.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "core/robot/arm_kinematics.h"
#include "core/ros1/message_codec.h"
#include "core/ros1/ros_topics.h"
#include "core/ros1/stamp.h"

namespace capstan::live {
namespace {

using tracking::Snapshot;

std::array<double, 3> listOf(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

/// Shared by the sessions of one namespace.
class EstimateTopics::Writers {
 public:
  explicit Writers(const std::string& name)
      : joints_(name + "/measured_js", ros1::typeOf<ros1::JointState>()),
        pose_(name + "/measured_cp", ros1::typeOf<ros1::PoseStamped>()),
        covariance_(name + "/measured_cp_covariance", ros1::typeOf<ros1::PoseWithCovarianceStamped>()),
        marker_(name + "/marker", ros1::typeOf<ros1::PointStamped>()) {}

  void publish(const ros1::JointState& m) { joints_.publish(ros1::encode(m)); }
  void publish(const ros1::PoseStamped& m) { pose_.publish(ros1::encode(m)); }
  void publish(const ros1::PoseWithCovarianceStamped& m) { covariance_.publish(ros1::encode(m)); }
  void publish(const ros1::PointStamped& m) { marker_.publish(ros1::encode(m)); }

 private:
  ros1::TopicWriter joints_, pose_, covariance_, marker_;
};

/// One session; used by its pipeline's thread.
class EstimateTopics::Session {
 public:
  Session(std::shared_ptr<Writers> writers, const tracking::SourceInfo& info) : writers_(std::move(writers)) {
    for (const robot::Joint& joint : info.robot.joints) names_.push_back(joint.name);
  }

  void begin(const tracking::TrackingPipeline& pipeline) { arm_.emplace(pipeline.robot()); }

  void take(const tracking::Sample&, const Snapshot& s) {
    if (s.motor_updated && s.t - published_ > 0.999 / kMostRate) publishEstimate(s);
    if (s.camera_updated && s.tip_cam.allFinite())
      writers_->publish(ros1::PointStamped{{stampOf(s.t_cam), "base"}, listOf(s.tip_cam)});
  }

 private:
  void publishEstimate(const Snapshot& s) {
    published_ = s.t;
    const ros1::MessageHeader header{stampOf(s.t), "base"};
    const auto vector = [](const Eigen::Vector3d& v) { return std::vector<double>(v.begin(), v.end()); };
    writers_->publish(ros1::JointState{header, names_, vector(s.q_link_ukf), vector(s.dq_link_ukf), {}});
    if (!arm_ || !s.q_link_ukf.allFinite()) return;
    const Eigen::Quaterniond turn(arm_->frame(3, s.q_link_ukf).rotation());
    const std::array<double, 4> orientation = {turn.x(), turn.y(), turn.z(), turn.w()};
    writers_->publish(ros1::PoseStamped{header, listOf(s.tip_ukf), orientation});
    ros1::PoseWithCovarianceStamped pose{header, listOf(s.tip_ukf), orientation, {}};
    constexpr std::size_t kSize = 6, kFirstTurn = 3 * kSize + 3;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        pose.covariance[kSize * static_cast<std::size_t>(i) + static_cast<std::size_t>(j)] =
            s.tip_ukf_covariance(i, j);
    pose.covariance[kFirstTurn] = -1.0;
    writers_->publish(pose);
  }

  std::int64_t stampOf(double t) {
    if (!begin_) begin_ = {t, ros1::rosTimeNow()};
    return begin_->second + ros1::nanosecondsOf(t - begin_->first);
  }

  const std::shared_ptr<Writers> writers_;
  std::vector<std::string> names_;
  std::optional<robot::ArmKinematics> arm_;
  std::optional<std::pair<double, std::int64_t>> begin_;  ///< session's time and ROS time of the first sample
  double published_ = -std::numeric_limits<double>::infinity();
};

EstimateTopics::EstimateTopics(std::string name_space)
    : writers_(std::make_shared<Writers>(std::move(name_space))) {}

EstimateTopics::~EstimateTopics() = default;

Listener EstimateTopics::begin(const tracking::SourceInfo& info) {
  const auto session = std::make_shared<Session>(writers_, info);
  return {[session](const tracking::TrackingPipeline& pipeline) { session->begin(pipeline); },
          [session](const tracking::Sample& sample, const Snapshot& s) { session->take(sample, s); }};
}

}  // namespace capstan::live
