#include "app/cli/registering.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <vector>

#include "app/cli/console.h"
#include "core/base/yaml.h"
#include "core/registration/registration_guide.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"
#include "core/vision/registration.h"
#include "core/vision/registration_file.h"

namespace capstan::cli {
namespace {

/// Tracks the recording without a registration and calls `each` with every snapshot.
template <class Each>
void runUnregistered(const SourceFactory& open, const tracking::TrackingOptions& options, Each each) {
  const auto source = open();
  tracking::SourceInfo info = source->info();
  info.base_from_camera.reset();
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info, options);
  tracking::trackAll(*source, pipeline, nullptr, 0.0,
                     [&](const tracking::Sample&, const tracking::Snapshot& snapshot) { each(snapshot); });
}

/// `text` without its last full stop, because the error message adds one.
std::string clause(std::string text) {
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

Eigen::Isometry3d atHardStop(const std::string& mounting, const SourceFactory& open,
                             const tracking::TrackingOptions& options, std::string& message) {
  const auto info = open()->info();
  if (!info.rig)
    refuseOption("--register", "hard-stop", "the recording holds no images",
                 "Give a recording with images, or --register kinematics or a file");
  std::optional<Eigen::Isometry3d> known = info.base_from_camera;
  if (!mounting.empty()) known = vision::readRegistration(mounting);
  registration::RegistrationGuide guide(info.robot, info.rig);
  guide.start(known);
  runUnregistered(open, options, [&](const tracking::Snapshot& snapshot) {
    if (guide.step() == registration::RegistrationStep::kReview) return;
    guide.observe(snapshot);
    if (guide.step() != registration::RegistrationStep::kReview && guide.canCollect()) guide.collect();
  });
  if (!guide.proposal())
    refuseOption("--register", "hard-stop",
                 guide.reason().empty() ? "the recording has no long enough rest at the hard stop"
                                        : clause(guide.reason()),
                 guide.advice().empty() ? "Record one, or give --register kinematics or a file"
                                        : clause(guide.advice()));
  const vision::Registration& found = guide.proposal()->registration;
  message =
      fmt::format("registered at the hard stop: {} frames, rms {:.2f} mm", found.frames, 1e3 * found.rms);
  return found.base_from_camera;
}

Eigen::Isometry3d againstKinematics(const SourceFactory& open, const tracking::TrackingOptions& options,
                                    std::string& message) {
  std::vector<Eigen::Vector3d> seen, kinematic;
  runUnregistered(open, options, [&](const tracking::Snapshot& snapshot) {
    if (!snapshot.camera_updated || snapshot.gate != tracking::Gate::kUnregistered) return;
    if (!snapshot.tip_kin_cam.allFinite()) return;
    seen.push_back(snapshot.tip_in_camera);
    kinematic.push_back(snapshot.tip_kin_cam);
  });
  const auto found = vision::registerRigid(seen, kinematic);
  if (!found)
    refuseOption("--register", "kinematics", std::string(base::nameOf(found.error())),
                 "Give a recording with images and movement");
  message =
      fmt::format("registered against kinematics: {} frames, rms {:.2f} mm", found->frames, 1e3 * found->rms);
  return found->base_from_camera;
}

}  // namespace

Eigen::Isometry3d registerBy(const std::string& method, const std::string& mounting,
                             const SourceFactory& open, const tracking::TrackingOptions& options,
                             std::string& message) {
  if (method == "hard-stop") return atHardStop(mounting, open, options, message);
  if (method == "kinematics") return againstKinematics(open, options, message);
  message = "registered by " + method;
  return vision::readRegistration(method);
}

}  // namespace capstan::cli
