#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/registration/camera_order.h"
#include "core/robot/description.h"
#include "core/tracking/snapshot.h"
#include "core/vision/registration.h"

/// State machine of the guided hard-stop registration, UKF paper (1): drive to the hard stop, collect
/// triangulated points, review the result. Its only input and its only clock are snapshots; it does not
/// depend on a window.
namespace capstan::registration {

enum class RegistrationStep { kIdle, kDrive, kCollect, kRefused, kReview, kAccepted, kRejected };

/// Reason why a collection was refused.
enum class RegistrationFault {
  kNone,
  kNoRotation,
  kArmMoved,
  kTooFewDetections,
  kScatterTooLarge,
  kCamerasExchanged,
  kViewsDisagree
};

/// Whether a triangulated point was used.
enum class PointVerdict { kUsed, kOutlier };

/// Position of the arm with respect to the hard stop.
struct StopArrival {
  Eigen::Vector3d distance = Eigen::Vector3d::Zero();  ///< q_kin − q_hs [rad, rad, m]
  std::array<bool, 3> near{};                          ///< whether each joint is at its stop
  double rest = 0.0;                                   ///< time since the arm came to rest [s]
  bool arrived = false;                                ///< all joints near, and at rest for kRestTime
};

/// One triangulated point of the collection.
struct RegistrationPoint {
  double t = 0.0;                                      ///< time of exposure [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position in the left camera's frame [m]
  PointVerdict verdict = PointVerdict::kUsed;
  int axis = 0;         ///< axis with the largest distance from the median
  double excess = 0.0;  ///< distance from the median along `axis`, in σ
};

/// Centre and scatter of the used points in the left camera's frame.
struct PointScatter {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();   ///< standard deviation of one point [m]
  int used = 0;
  int outliers = 0;
};

/// Result of a finished registration, and its effect on the registration in use.
struct RegistrationProposal {
  vision::Registration registration;
  /// 95 % half-widths of the tool position due to the scatter, in frame 0 [m]: 1.96 times sigma.
  Eigen::Vector3d half_width = Eigen::Vector3d::Zero();
  /// Displacement of the measured tip in frame 0 when the proposal replaces the registration in use [m]; 0
  /// when none is in use.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  /// Displacement of the tip at the far end of the workspace due to an error of one degree in the mounting
  /// rotation [m]. One pose cannot measure this error.
  double per_degree = 0.0;
};

class RegistrationGuide {
 public:
  static constexpr int kFrames = 60;        ///< number of accepted points that make a registration
  static constexpr double kRestTime = 0.5;  ///< time at rest before collecting [s]

  /// With `rig` the guide can distinguish exchanged cameras from a marker that was not found.
  explicit RegistrationGuide(const robot::Description& robot,
                             const std::optional<vision::StereoRig>& rig = {});

  /// Begins at step kDrive. `current` is the registration in use or the nominal mounting; its rotation is the
  /// known ⁰R of (1). Without `current` the guide refuses with kNoRotation.
  void start(const std::optional<Eigen::Isometry3d>& current);
  /// Takes the next snapshot. Call it for every snapshot in order; one with camera_updated contains a point.
  void observe(const tracking::Snapshot& snapshot);
  /// Begins step 2, also to repeat it ("redo"). Returns false when the arm is not at rest at the hard stop.
  bool collect();
  /// Whether collect() would begin now.
  bool canCollect() const;
  /// Lets the user confirm the hard stop of a recording with another homing, outside the tolerance.
  void overrideStop(bool on) { stop_overridden_ = on; }
  void accept();                    ///< kReview → kAccepted
  void reject(std::string reason);  ///< any → kRejected
  void leave();                     ///< → kIdle
  void back();                      ///< kCollect, kRefused, kReview → kDrive

  RegistrationStep step() const { return step_; }
  RegistrationFault fault() const { return fault_; }
  /// Reason of the refusal with its numbers, and the remedy; both are empty without a fault.
  const std::string& reason() const { return reason_; }
  const std::string& advice() const { return advice_; }
  const StopArrival& arrival() const { return arrival_; }
  const std::vector<RegistrationPoint>& points() const { return points_; }
  const PointScatter& scatter() const { return scatter_; }
  int framesSeen() const { return frames_seen_; }
  const std::optional<RegistrationProposal>& proposal() const { return proposal_; }
  /// Joint positions at which the points were collected, by transmission kinematics [rad, rad, m].
  const Eigen::Vector3d& collectedPose() const { return collect_pose_; }
  const std::optional<Eigen::Isometry3d>& current() const { return current_; }
  const robot::Description& robot() const { return robot_; }

 private:
  void watchRest(const tracking::Snapshot& snapshot);
  void takeFrame(const tracking::Snapshot& snapshot);
  void judgePoints();
  void finish();
  void refuse(RegistrationFault fault, std::string reason, std::string advice);
  void refuseTooFew();
  bool refuseViews();

  robot::Description robot_;
  RegistrationStep step_ = RegistrationStep::kIdle;
  RegistrationFault fault_ = RegistrationFault::kNone;
  std::string reason_, advice_;
  std::optional<Eigen::Isometry3d> current_;
  bool stop_overridden_ = false;
  StopArrival arrival_;
  Eigen::Vector3d rest_pose_ = Eigen::Vector3d::Zero();
  double rest_since_ = 0.0;
  bool resting_ = false;
  double collect_since_ = 0.0;
  Eigen::Vector3d collect_pose_ = Eigen::Vector3d::Zero();
  int frames_seen_ = 0;
  std::optional<vision::Triangulator> triangulator_;
  int exchanged_ = 0, disagreeing_ = 0;  ///< frames whose two rays do not meet, by CameraOrder
  static constexpr std::size_t kFaults = base::NamesOf<vision::MarkerFault>::value.size();
  std::array<std::array<int, kFaults>, 2> lost_{};  ///< frames by camera and vision::MarkerFault
  std::vector<RegistrationPoint> points_;
  std::vector<Eigen::Vector3d> used_;
  PointScatter scatter_;
  std::optional<RegistrationProposal> proposal_;
};

}  // namespace capstan::registration

template <>
struct capstan::base::NamesOf<capstan::registration::RegistrationFault> {
  using F = capstan::registration::RegistrationFault;
  static constexpr std::array value = {
      std::pair{F::kNone, "ok"},
      std::pair{F::kNoRotation, "camera mounting unknown"},
      std::pair{F::kArmMoved, "the arm moved"},
      std::pair{F::kTooFewDetections, "too few detections"},
      std::pair{F::kScatterTooLarge, "scatter too large"},
      std::pair{F::kCamerasExchanged, "left and right camera seem to be exchanged"},
      std::pair{F::kViewsDisagree, "the two cameras do not see the same point"}};
};
