#include "core/live/tip_transforms.h"

#include <chrono>
#include <limits>
#include <optional>

#include "core/live/streams/igtl_message.h"
#include "core/live/streams/row_stream.h"
#include "core/robot/arm_kinematics.h"

namespace capstan::live {
namespace {

double timeNow() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

/// One session; used by its pipeline's thread.
class TipTransforms::Session {
 public:
  explicit Session(std::shared_ptr<RowStream> stream) : stream_(std::move(stream)) {}

  void begin(const tracking::TrackingPipeline& pipeline) {
    arm_.emplace(pipeline.robot());
    base_from_camera_ = pipeline.registration();
  }

  void take(const tracking::Snapshot& s) {
    if (!s.motor_updated || s.t - sent_ < 0.999 / kMostRate || !s.q_link_ukf.allFinite() || !arm_) return;
    sent_ = s.t;
    if (!begin_) begin_ = timeNow() - s.t;
    Eigen::Isometry3d tip = arm_->frame(3, s.q_link_ukf);
    tip.translation() = s.tip_ukf;
    stream_->send(igtlTransform("TipToBase", tip, *begin_ + s.t));
    if (base_from_camera_) stream_->send(igtlTransform("CameraToBase", *base_from_camera_, *begin_ + s.t));
  }

 private:
  const std::shared_ptr<RowStream> stream_;
  std::optional<robot::ArmKinematics> arm_;
  std::optional<Eigen::Isometry3d> base_from_camera_;
  std::optional<double> begin_;  ///< time since 1970 at the session's time 0 [s]
  double sent_ = -std::numeric_limits<double>::infinity();
};

TipTransforms::TipTransforms(const Address& address)
    : stream_(std::make_shared<RowStream>(address, std::string())) {}

TipTransforms::~TipTransforms() = default;

std::string TipTransforms::address() const {
  const std::string& tcp = stream_->name();
  return "igtl" + tcp.substr(tcp.find(':'));
}

Listener TipTransforms::begin(const tracking::SourceInfo&) {
  const auto session = std::make_shared<Session>(stream_);
  return {[session](const tracking::TrackingPipeline& pipeline) { session->begin(pipeline); },
          [session](const tracking::Sample&, const tracking::Snapshot& s) { session->take(s); }};
}

}  // namespace capstan::live
