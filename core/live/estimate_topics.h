#pragma once

#include <memory>
#include <string>

#include "core/live/estimate_output.h"

namespace capstan::live {

/// Publishes the estimates of a session on ROS topics below a namespace, as CRTK names them, at most
/// kMostRate times a second:
///     measured_js             sensor_msgs/JointState: q_ukf [rad or m] and its rate
///     measured_cp             geometry_msgs/PoseStamped: tip [m] and orientation of the last link in frame 0
///     measured_cp_covariance  geometry_msgs/PoseWithCovarianceStamped: the same with the tip's covariance;
///                             that of the orientation is not known: −1 as its first entry
///     marker                  geometry_msgs/PointStamped: tip as the cameras see it, frame 0, at its
///     exposure
/// Stamps are the ROS time of the first sample's arrival plus the session's time since then.
class EstimateTopics final : public EstimateOutput {
 public:
  /// Throws base::InputError for a name that is no namespace, and where this program was built without ROS.
  explicit EstimateTopics(std::string name_space);
  ~EstimateTopics() override;

  Listener begin(const tracking::SourceInfo& info) override;

  static constexpr double kMostRate = 1000.0;  ///< [1/s]

 private:
  class Session;
  class Writers;
  std::shared_ptr<Writers> writers_;
};

}  // namespace capstan::live
