#include "core/experiments/training_motions.h"

#include "core/experiments/require_option.h"
#include "core/experiments/tool_rig.h"
#include "core/learning/poses/rotation_vector.h"
#include "core/learning/poses/screen_poses.h"

namespace capstan::experiments {
namespace {

using learning::StreamKind;

constexpr int kWaypoints = 10;
constexpr double kOpening = 0.2;  // opening of the jaws [rad]

std::vector<learning::CorrectedWaypoint> uncorrected(const std::vector<learning::Waypoint>& motion,
                                                     const learning::Reachable& reachable) {
  std::vector<learning::CorrectedWaypoint> path;
  for (const learning::Waypoint& waypoint : motion) {
    const learning::WithinReach reached =
        learning::withinReach(waypoint.pose, waypoint.pose, waypoint.pose, reachable);
    path.push_back({waypoint.t, waypoint.pose, reached.pose, 1.0, reached.limit});
  }
  return path;
}

/// Random pose on the widened grid, with a random tilt of the tool.
Eigen::Isometry3d drawnPose(base::Random& random, const DebridementScene& scene,
                            const TrainingOptions& options) {
  const Fragment place = drawnFragment(random, options.margin, TrainingOptions::kMostYaw);
  const double tilt = options.most_tilt;
  const Eigen::Vector3d across(0.0, random.uniform(-tilt, tilt), random.uniform(-tilt, tilt));
  Eigen::Isometry3d pose = scene.pose(place.place, place.yaw);
  pose.linear() *= learning::turnBy(across).toRotationMatrix();
  return pose;
}

}  // namespace

void checkTraining(const TrainingOptions& options) {
  requireOption("motions", options.motions, 1, 100'000);
  requireOption("training speed [m/s]", options.speed, 1e-4, 1.0);
  requireOption("rest [s]", options.rest, 0.0, 60.0);
  requireOption("margin [m]", options.margin, 0.0, 0.05);
  requireOption("most_tilt [rad]", options.most_tilt, 0.0, 1.0);
}

std::vector<learning::RawMotion> recordTraining(const robot::Description& robot,
                                                const simulation::ToolTruth& truth,
                                                const TrainingOptions& options,
                                                const base::Progress* progress) {
  checkTraining(options);
  const DebridementScene scene = debridementScene(robot);
  robot::JointVector start = scene.start;
  start[robot::kToolJoints - 1] = kOpening;
  start[robot::kToolJoints - 2] = -0.5 * kOpening;
  ToolRig rig(robot, truth, start, options.seed);
  base::Random random(options.seed, "training motions");
  std::vector<learning::RawMotion> motions;
  while (static_cast<int>(motions.size()) < options.motions && !(progress && progress->cancelled())) {
    const auto path = uncorrected(
        straightMotion(rig.commanded(), drawnPose(random, scene, options), options.speed, kWaypoints),
        rig.reachable());
    if (!learning::withinReach(path)) continue;  // the arm does not reach this corner of the grid
    learning::RawMotion motion;
    motion.name = "motion " + std::to_string(motions.size() + 1);
    rig.recordTo(&motion);
    rig.rest(options.rest);
    rig.follow(path);
    rig.rest(options.rest);
    rig.recordTo(nullptr);
    motions.push_back(std::move(motion));
  }
  return motions;
}

TrainedCorrection trainedOn(const std::vector<learning::RawMotion>& motions, const TrainingOptions& options,
                            base::Progress* progress) {
  const learning::ScreenReport screened = learning::screenPoses(motions);
  const double clock_offset =
      learning::clockOffsetBetween(screened.motions, StreamKind::kCommand).clock_offset;
  const std::vector<learning::State> states =
      learning::statesOf(screened.motions, StreamKind::kCommand, clock_offset);
  const learning::CleaningReport cleaned = learning::cleanStates(states, options.cleaning);
  const std::vector<learning::State> clean = learning::kept(states, cleaned);
  constexpr auto kCamera = static_cast<std::size_t>(StreamKind::kCamera);
  return {.model = learning::CorrectionModel::trained(clean, options.correction, progress),
          .motions = motions.size(),
          .rows = screened.rows[kCamera],
          .screened = screened.rows[kCamera] - screened.poses[kCamera],
          .states = states.size(),
          .kept = clean.size(),
          .clock_offset = clock_offset};
}

}  // namespace capstan::experiments
