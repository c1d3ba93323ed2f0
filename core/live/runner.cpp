#include "core/live/runner.h"

#include "core/live/runner_impl.h"

namespace capstan::live {

Listener both(Listener one, Listener other) {
  if (!one) return other;
  if (!other) return one;
  return {[one, other](const tracking::TrackingPipeline& pipeline) {
            one.begin(pipeline);
            other.begin(pipeline);
          },
          [one, other](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
            one.take(sample, snapshot);
            other.take(sample, snapshot);
          }};
}

Runner::Runner(std::unique_ptr<tracking::Source> source, tracking::TrackingPipeline pipeline,
               const RunnerOptions& options)
    : impl_(std::make_unique<Impl>(std::move(source), std::move(pipeline), options)) {}
Runner::~Runner() = default;

const tracking::SourceInfo& Runner::info() const { return impl_->info(); }
void Runner::run() { impl_->setMode(RunState::kRunning); }
void Runner::pause() { impl_->setMode(RunState::kPaused); }
void Runner::stepFrame() { impl_->stepFrame(); }
void Runner::setSpeed(double speed) { impl_->setSpeed(speed); }
void Runner::block(bool left, bool right) { impl_->block(left, right); }
void Runner::setOcclusion(const OcclusionSchedule& schedule) { impl_->setOcclusion(schedule); }
void Runner::setMarker(const vision::MarkerOptions& marker) { impl_->setMarker(marker); }
vision::MarkerOptions Runner::marker() const { return impl_->inUse().marker(); }
void Runner::setRegistration(const Eigen::Isometry3d& base_from_camera) {
  impl_->setRegistration(base_from_camera);
}
void Runner::setRobot(const robot::Description& robot, const std::string& note) {
  impl_->setRobot(robot, note);
}
robot::Description Runner::robot() const { return impl_->inUse().robot(); }
void Runner::setTracking(const tracking::TrackingOptions& options) { impl_->setTracking(options); }
tracking::TrackingOptions Runner::tracking() const { return impl_->inUse().tracking(); }
void Runner::setImages(const vision::ImageCorrection& images) { impl_->setImages(images); }
void Runner::setRig(const vision::StereoRig& rig, const std::string& note) { impl_->setRig(rig, note); }
vision::ImageCorrection Runner::images() const { return impl_->inUse().images(); }
tracking::SourceInfo Runner::infoInUse() const { return impl_->inUse().info(); }
void Runner::listen(Listener listener) { impl_->listen(std::move(listener)); }
void Runner::resetErrors() { impl_->resetErrors(); }
void Runner::note(std::string text) { impl_->note(std::move(text)); }
void Runner::post(Command command) { impl_->command(std::move(command)); }
recording::SessionHeader Runner::inUse(recording::SessionHeader header) const {
  return impl_->inUse().of(std::move(header));
}
void Runner::startRecording(const std::filesystem::path& path, const recording::SessionHeader& header,
                            const recording::RecorderOptions& options) {
  impl_->startRecording(path, header, options);
}
void Runner::stopRecording() { impl_->stopRecording(); }
std::shared_ptr<const recording::Recorder> Runner::recorder() const { return impl_->recorder(); }
RunStatus Runner::status() const { return impl_->status(); }
tracking::TrackReport Runner::report() const { return impl_->report(); }
std::vector<tracking::HealthCheck> Runner::health() const { return impl_->health(); }
bool Runner::takeSnapshot(tracking::Snapshot& out) { return impl_->publisher().takeSnapshot(out); }
bool Runner::takeFrames(tracking::StereoFrame& out, tracking::Snapshot* seen) {
  return impl_->publisher().takeFrames(out, seen);
}
std::size_t Runner::drainHistory(std::vector<tracking::Snapshot>& out) {
  return impl_->publisher().drainHistory(out);
}
bool Runner::waitUntilIdle(double seconds) { return impl_->waitUntilIdle(seconds); }

}  // namespace capstan::live
