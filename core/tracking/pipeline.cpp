#include "core/tracking/pipeline.h"

#include <utility>

#include "core/tracking/pipeline_impl.h"

namespace capstan::tracking {

TrackingPipeline::TrackingPipeline(const robot::Description& robot, std::optional<vision::StereoRig> rig,
                                   const vision::MarkerOptions& marker, const TrackingOptions& options)
    : impl_(std::make_unique<Impl>(robot, std::move(rig), marker, options)) {}
TrackingPipeline::~TrackingPipeline() = default;
TrackingPipeline::TrackingPipeline(TrackingPipeline&&) noexcept = default;
TrackingPipeline& TrackingPipeline::operator=(TrackingPipeline&&) noexcept = default;

void TrackingPipeline::setRegistration(const Eigen::Isometry3d& base_from_camera) {
  impl_->setRegistration(base_from_camera);
}
const std::optional<Eigen::Isometry3d>& TrackingPipeline::registration() const {
  return impl_->base_from_camera_;
}
void TrackingPipeline::setOwnKinematics(bool own) { impl_->setOwnKinematics(own); }
void TrackingPipeline::setMarker(const vision::MarkerOptions& marker) { impl_->setMarker(marker); }
void TrackingPipeline::setMotorFailed(int motor, bool failed) { impl_->declare(motor, failed); }
const Snapshot& TrackingPipeline::step(const Sample& sample) { return impl_->step(sample); }
const Snapshot& TrackingPipeline::snapshot() const { return impl_->snapshot(); }
void TrackingPipeline::reset() { impl_->reset(); }
const robot::Description& TrackingPipeline::robot() const { return impl_->robot_; }
const std::optional<vision::StereoRig>& TrackingPipeline::rig() const { return impl_->rig_; }
const TrackingOptions& TrackingPipeline::options() const { return impl_->options_; }

}  // namespace capstan::tracking
