#include "core/registration/registration_guide.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/registration/camera_checks.h"
#include "core/registration/camera_order.h"
#include "core/robot/arm_kinematics.h"
#include "core/stats/interval.h"
#include "core/stats/quantile.h"

namespace capstan::registration {

namespace {

using Eigen::Vector3d;

constexpr double kMadToSigma = 1.4826;   // median absolute deviation of a normal distribution, inverted
constexpr double kLeastScale = 1e-5;     // [m] smallest spread that is noise and not rounding
constexpr int kLeastToJudge = 5;         // smallest number of points for a meaningful median
constexpr double kDetectionShare = 0.5;  // smallest share of the frames that must give a point
constexpr double kOutlierSigma = 4.0;    // distance from the median beyond which a point is an outlier [σ]
const Vector3d kStopTolerance(0.035, 0.035, 0.003);     // |q_kin − q_hs| at the stop [rad, rad, m]
const Vector3d kRestTolerance(0.0018, 0.0018, 0.0002);  // largest travel at rest [rad, rad, m]
const Vector3d kScatterLimit(0.0015, 0.0015, 0.006);    // largest σ of a point, camera x, y, z [m]

std::string jointText(const robot::Joint& joint, double value) {
  return joint.type == robot::JointType::kRevolute ? fmt::format("{:.2f} deg", base::toDegrees(value))
                                                   : fmt::format("{:.2f} mm", base::toMillimetres(value));
}

}  // namespace

RegistrationGuide::RegistrationGuide(const robot::Description& robot,
                                     const std::optional<vision::StereoRig>& rig)
    : robot_(robot) {
  if (rig) triangulator_.emplace(*rig);
}

void RegistrationGuide::start(const std::optional<Eigen::Isometry3d>& current) {
  step_ = RegistrationStep::kDrive;
  fault_ = RegistrationFault::kNone;
  reason_.clear();
  advice_.clear();
  current_ = current;
  stop_overridden_ = false;
  arrival_ = {};
  resting_ = false;
  frames_seen_ = 0;
  points_.clear();
  scatter_ = {};
  proposal_.reset();
  if (!current)
    refuse(RegistrationFault::kNoRotation,
           "The rotation of the cameras towards the robot's base is not known.",
           "Register from several poses instead, or name a registration in the live set-up: registration: "
           "FILE.");
}

void RegistrationGuide::observe(const tracking::Snapshot& snapshot) {
  if (step_ == RegistrationStep::kIdle) return;
  watchRest(snapshot);
  if (step_ != RegistrationStep::kCollect) return;
  const Vector3d travel = (snapshot.q_link_kin - collect_pose_).cwiseAbs();
  for (int i = 0; i < 3; ++i)
    if (travel(i) > kRestTolerance(i)) {
      const auto& joint = robot_.joints[static_cast<std::size_t>(i)];
      return refuse(RegistrationFault::kArmMoved,
                    fmt::format("{} moved by {} after {} points.", joint.name, jointText(joint, travel(i)),
                                points_.size()),
                    "Hold the arm against its stop until the frames are collected.");
    }
  if (snapshot.camera_updated && snapshot.t_cam >= collect_since_) takeFrame(snapshot);
}

void RegistrationGuide::watchRest(const tracking::Snapshot& snapshot) {
  const Vector3d& q = snapshot.q_link_kin;
  if (!q.allFinite()) return;
  const bool moved = !resting_ || ((q - rest_pose_).cwiseAbs().array() > kRestTolerance.array()).any();
  if (moved) {
    resting_ = true;
    rest_pose_ = q;
    rest_since_ = snapshot.t;
  }
  arrival_.distance = q - robot::homingOf(robot_);
  bool all = true;
  for (int i = 0; i < 3; ++i) {
    arrival_.near[static_cast<std::size_t>(i)] = std::abs(arrival_.distance(i)) <= kStopTolerance(i);
    all = all && arrival_.near[static_cast<std::size_t>(i)];
  }
  arrival_.rest = snapshot.t - rest_since_;
  arrival_.arrived = all && arrival_.rest >= kRestTime;
}

bool RegistrationGuide::canCollect() const {
  if (!current_ || step_ == RegistrationStep::kIdle || step_ == RegistrationStep::kCollect) return false;
  return arrival_.arrived || (stop_overridden_ && arrival_.rest >= kRestTime);
}

bool RegistrationGuide::collect() {
  if (!canCollect()) return false;
  step_ = RegistrationStep::kCollect;
  fault_ = RegistrationFault::kNone;
  reason_.clear();
  advice_.clear();
  collect_pose_ = rest_pose_;
  collect_since_ = rest_since_;
  frames_seen_ = exchanged_ = disagreeing_ = 0;
  lost_ = {};
  points_.clear();
  scatter_ = {};
  proposal_.reset();
  return true;
}

void RegistrationGuide::takeFrame(const tracking::Snapshot& snapshot) {
  ++frames_seen_;
  bool both = true;
  for (std::size_t side = 0; side < 2; ++side) {
    ++lost_[side][static_cast<std::size_t>(snapshot.marker[side].fault)];
    both = both && snapshot.marker[side].found();
  }
  if (both && snapshot.tip_in_camera.allFinite()) {
    points_.push_back({snapshot.t_cam, snapshot.tip_in_camera});
    judgePoints();
  } else if (both && triangulator_) {
    const CameraOrder order = cameraOrder(*triangulator_, snapshot.marker, kEpipolarLimit);
    exchanged_ += order == CameraOrder::kExchanged;
    disagreeing_ += order == CameraOrder::kNoFit;
  }
  if (scatter_.used >= kFrames) return finish();
  if (frames_seen_ >= kFrames && scatter_.used < kDetectionShare * frames_seen_) refuseTooFew();
}

void RegistrationGuide::judgePoints() {
  Vector3d scale = Vector3d::Constant(kLeastScale);
  std::vector<double> values(points_.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points_.begin(), points_.end(), values.begin(),
                   [&](const auto& p) { return p.position(axis); });
    scatter_.median(axis) = stats::median(values);
    for (std::size_t i = 0; i < points_.size(); ++i)
      values[i] = std::abs(points_[i].position(axis) - scatter_.median(axis));
    scale(axis) = std::max(kLeastScale, kMadToSigma * stats::median(values));
  }
  used_.clear();
  for (auto& point : points_) {
    const Vector3d excess = (point.position - scatter_.median).cwiseAbs().cwiseQuotient(scale);
    point.excess = excess.maxCoeff(&point.axis);
    const bool outlier = static_cast<int>(points_.size()) >= kLeastToJudge && point.excess > kOutlierSigma;
    point.verdict = outlier ? PointVerdict::kOutlier : PointVerdict::kUsed;
    if (!outlier) used_.push_back(point.position);
  }
  scatter_.used = static_cast<int>(used_.size());
  scatter_.outliers = static_cast<int>(points_.size()) - scatter_.used;
  scatter_.mean.setZero();
  scatter_.sigma.setZero();
  for (const auto& p : used_) scatter_.mean += p / scatter_.used;
  if (scatter_.used < 2) return;
  for (const auto& p : used_) scatter_.sigma += (p - scatter_.mean).cwiseAbs2() / (scatter_.used - 1);
  scatter_.sigma = scatter_.sigma.cwiseSqrt();
}

void RegistrationGuide::finish() {
  for (int axis = 0; axis < 3; ++axis)
    if (scatter_.sigma(axis) > kScatterLimit(axis))
      return refuse(
          RegistrationFault::kScatterTooLarge,
          fmt::format("The points scatter by {:.2f} mm σ along camera {}; at most {:.2f} mm is allowed.",
                      base::toMillimetres(scatter_.sigma(axis)), "xyz"[axis],
                      base::toMillimetres(kScatterLimit(axis))),
          "Use steady light, check that the marker is whole and in focus, or move the cameras nearer.");
  const robot::ArmKinematics arm(robot_);
  const Vector3d marker = arm.tip(collect_pose_);
  RegistrationProposal proposal;
  proposal.registration = vision::registerAtHardStop(used_, current_->linear(), marker).value();
  proposal.half_width = stats::kNormal95 * proposal.registration.sigma;
  proposal.shift = proposal.registration.base_from_camera * scatter_.mean - *current_ * scatter_.mean;
  Vector3d corner;
  double farthest = 0.0;
  for (int k = 0; k < 8; ++k) {
    for (int i = 0; i < 3; ++i) {
      const auto& joint = robot_.joints[static_cast<std::size_t>(i)];
      corner(i) = ((k >> i) & 1) ? joint.limit_high : joint.limit_low;
    }
    farthest = std::max(farthest, (arm.tip(corner) - marker).norm());
  }
  proposal.per_degree = base::kRadiansPerDegree * farthest;
  proposal_ = proposal;
  step_ = RegistrationStep::kReview;
}

/// Refuses when both cameras found a marker but in most frames not the same point; returns false otherwise.
bool RegistrationGuide::refuseViews() {
  const double most = kDetectionShare * frames_seen_;
  if (exchanged_ > most) {
    refuse(RegistrationFault::kCamerasExchanged,
           fmt::format(
               "Both cameras saw the marker, but in {} of {} frames it would lie behind them. It lies in "
               "front of them when the left image is taken for the right one.",
               exchanged_, frames_seen_),
           "Most likely the left and the right stream are exchanged: exchange them, or the two camera files, "
           "and "
           "open the source again.");
    return true;
  }
  if (disagreeing_ + exchanged_ <= most) return false;
  refuse(RegistrationFault::kViewsDisagree,
         fmt::format("Both cameras saw a marker, but in {} of {} frames the two rays do not meet.",
                     disagreeing_ + exchanged_, frames_seen_),
         "Check that the camera files belong to these cameras and that both images are of the same time, and "
         "remove other objects of the marker's colour from the view.");
  return true;
}

void RegistrationGuide::refuseTooFew() {
  if (refuseViews()) return;
  std::string why;
  vision::MarkerFault worst = vision::MarkerFault::kNoPixels;
  int most = 0;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t fault = 1; fault < lost_[side].size(); ++fault)
      if (lost_[side][fault] > most) {
        most = lost_[side][fault];
        worst = static_cast<vision::MarkerFault>(fault);
        why =
            fmt::format(" Mostly {}: {}, {} times.", side == 0 ? "left" : "right", base::nameOf(worst), most);
      }
  refuse(RegistrationFault::kTooFewDetections,
         fmt::format("{} of {} frames gave a usable point; {:.0f} are needed.{}", scatter_.used, frames_seen_,
                     std::ceil(kDetectionShare * frames_seen_), why),
         adviceAgainst(worst));
}

void RegistrationGuide::refuse(RegistrationFault fault, std::string reason, std::string advice) {
  step_ = RegistrationStep::kRefused;
  fault_ = fault;
  reason_ = std::move(reason);
  advice_ = std::move(advice);
}

void RegistrationGuide::accept() {
  if (step_ == RegistrationStep::kReview) step_ = RegistrationStep::kAccepted;
}

void RegistrationGuide::reject(std::string reason) {
  step_ = RegistrationStep::kRejected;
  reason_ = std::move(reason);
  advice_.clear();
}

void RegistrationGuide::back() {
  if (step_ == RegistrationStep::kCollect || step_ == RegistrationStep::kRefused ||
      step_ == RegistrationStep::kReview)
    start(current_);
}

void RegistrationGuide::leave() { step_ = RegistrationStep::kIdle; }

}  // namespace capstan::registration
