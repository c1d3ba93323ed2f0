#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/table.h"
#include "core/diagnosis/evidence/pose_evidence.h"
#include "core/diagnosis/hypotheses/pose_model.h"
#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

struct PoseOptions {
  std::optional<PoseReference> towards;  ///< none: kinematics where the table has them, else the command
  std::vector<std::string> only;         ///< names of effects to consider; empty: all
  std::uint64_t seed = 1;                ///< of the bootstraps
  bool show = true;                      ///< also signatures, and what the residual depends on
};

/// How far off a tip is with the effects known until then, on trajectories held out: of the three axes
/// together and of each [m].
struct PoseStep {
  std::string effect;  ///< that came last; empty: none yet
  double rms = 0.0;
  stats::Interval interval;  ///< 95 %, bootstrap of trajectories
  std::array<double, 3> axis{};
  double median = 0.0;  ///< distance that half of the observations are within
};

struct PoseReport {
  Report report;
  PoseReference towards = PoseReference::kKinematics;
  std::size_t fitted = 0, held_out = 0;  ///< trajectories
  std::vector<PoseStep> steps;
};

/// Differences between the tip that a robot's kinematics (or its commands) report and the tip that cameras
/// see: effects of pose_hypotheses.h, chosen and fitted on four trajectories in five (pose_selection.h); the
/// fifths measure its gain. Only positions are compared; the tool's orientation turns
/// `marker_offset`, and the registration's rotation is from positions alone.
///
/// The report's channels are the held-out observations, tip x, y, z of frame 0; each is "nominal" and
/// "refitted" as measured, for there is nothing to refit, and its times are the trajectories' one behind the
/// other. Noise is what differs from observation to observation. `nominal` is the robot file that effects of
/// cameras are put into where the reference is the kinematics. base::InputError: as motionsOf(), and a name
/// in `only` that is no effect of poses.
PoseReport diagnosePoses(const PoseEvidence& evidence, const robot::Description& nominal,
                         const PoseOptions& options = {}, base::Progress* progress = nullptr);
inline constexpr std::size_t kHeldOut = 5;  ///< one trajectory in so many

/// A row a step, in millimetres.
base::Table poseStepTable(const PoseReport& report);
/// jsonOf(Report) with "towards", "trajectories": {"fitted", "held_out"} and "steps": [{"effect", "rms",
/// "interval", "axis", "median"}] beside it.
nlohmann::json jsonOf(const PoseReport& report);

}  // namespace capstan::diagnosis
