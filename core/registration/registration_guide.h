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

/// The guided hard-stop registration, UKF paper (1), as a state machine fed with snapshots: drive to the hard
/// stop, collect triangulated points, review the result. Knows no window and no clock but the snapshots' own.
namespace capstan::registration {

enum class RegistrationStep { kIdle, kDrive, kCollect, kRefused, kReview, kAccepted, kRejected };

/// Why a collection was refused.
enum class RegistrationFault {
  kNone,
  kNoRotation,
  kArmMoved,
  kTooFewDetections,
  kScatterTooLarge,
  kCamerasExchanged,
  kViewsDisagree
};

/// What became of one triangulated point.
enum class PointVerdict { kUsed, kOutlier };

struct RegistrationOptions {
  int frames = 60;                                ///< accepted points that make a registration
  static constexpr double kDetectionShare = 0.5;  ///< least share of the frames that must give a point
  Eigen::Vector3d stop_tolerance{0.035, 0.035,
                                 0.003};  ///< |q_kin − q_hs| that counts as arrived [rad, rad, m]
  Eigen::Vector3d rest_tolerance{0.0018, 0.0018, 0.0002};  ///< travel that still counts as rest [rad, rad, m]
  static constexpr double kRestTime = 0.5;                 ///< stillness before collecting [s]
  static constexpr double kOutlierSigma = 4.0;             ///< distance from the median that rejects a point
  double epipolar_limit = 3.0;  ///< farther off, two views show no one marker, as when tracking [px]
  Eigen::Vector3d scatter_limit{0.0015, 0.0015, 0.006};  ///< largest σ of a point, camera x, y, z [m]
};

/// Where the arm is with respect to the hard stop.
struct StopArrival {
  Eigen::Vector3d distance = Eigen::Vector3d::Zero();  ///< q_kin − q_hs [rad, rad, m]
  std::array<bool, 3> near{};                          ///< within stop_tolerance, joint by joint
  double rest = 0.0;                                   ///< still for this long [s]
  bool arrived = false;                                ///< all near and still for rest_time
};

/// One triangulated point of the collection.
struct RegistrationPoint {
  double t = 0.0;                                      ///< exposure [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< left camera frame [m]
  PointVerdict verdict = PointVerdict::kUsed;
  int axis = 0;         ///< of an outlier: the worst axis
  double excess = 0.0;  ///< of an outlier: distance from the median, in σ
};

/// Centre and scatter of the used points, left camera frame.
struct PointScatter {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();   ///< standard deviation of one point [m]
  int used = 0;
  int outliers = 0;
};

/// A finished registration and what it would change.
struct RegistrationProposal {
  vision::Registration registration;
  /// 95 % half-widths of the tool position that the scatter leaves, frame 0 [m]: 1.96 times the translation's
  /// sigma.
  Eigen::Vector3d half_width = Eigen::Vector3d::Zero();
  /// How far the seen tip moves in frame 0 when the proposal replaces the registration in use [m]; 0 without
  /// one.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  /// Tip displacement that a mounting rotation wrong by one degree causes at the far end of the workspace
  /// [m]: the part of the error that one pose cannot show.
  double per_degree = 0.0;
};

class RegistrationGuide {
 public:
  /// With the `rig` the guide knows exchanged cameras from a marker that was not found.
  explicit RegistrationGuide(const robot::Description& robot, const RegistrationOptions& options = {},
                             const std::optional<vision::StereoRig>& rig = {});

  /// Begins at step kDrive. `current` is the registration in use or the nominal mounting: its rotation is the
  /// known ⁰R of (1). Without one the guide refuses with kNoRotation.
  void start(const std::optional<Eigen::Isometry3d>& current);
  /// Every snapshot, in order; snapshots with camera_updated carry a point.
  void observe(const tracking::Snapshot& snapshot);
  /// Step 2; also "redo". False when the arm is not at rest at the hard stop.
  bool collect();
  /// Whether collect() would begin now.
  bool canCollect() const;
  /// For a recording whose hard stop lies outside the tolerance (another homing): the user vouches for the
  /// place.
  void overrideStop(bool on) { stop_overridden_ = on; }
  void accept();                    ///< kReview → kAccepted
  void reject(std::string reason);  ///< any → kRejected
  void leave();                     ///< → kIdle
  void back();                      ///< kCollect, kRefused, kReview → kDrive

  RegistrationStep step() const { return step_; }
  RegistrationFault fault() const { return fault_; }
  /// What happened, with its numbers, and what to do about it; empty without a fault.
  const std::string& reason() const { return reason_; }
  const std::string& advice() const { return advice_; }
  const StopArrival& arrival() const { return arrival_; }
  const std::vector<RegistrationPoint>& points() const { return points_; }
  const PointScatter& scatter() const { return scatter_; }
  int framesSeen() const { return frames_seen_; }
  const std::optional<RegistrationProposal>& proposal() const { return proposal_; }
  /// Joints at which the points were collected, by transmission kinematics.
  const Eigen::Vector3d& collectedPose() const { return collect_pose_; }
  const std::optional<Eigen::Isometry3d>& current() const { return current_; }
  const RegistrationOptions& options() const { return options_; }
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
  RegistrationOptions options_;
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
  int exchanged_ = 0, disagreeing_ = 0;  ///< frames whose two detections do not meet, by CameraOrder
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
