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
  /// Poses that the observed poses are compared with. Empty: kinematics if the table has them, else commands.
  std::optional<PoseReference> towards;
  std::vector<std::string> only;  ///< names of effects to consider; empty: all
  std::uint64_t seed = 1;         ///< seed of the bootstraps
  Tolerance material;             ///< effects that move the tip less than ten times its length are no causes
  bool show = true;               ///< true: also signatures and the Gaussian process of the residual
};

/// Distance between observed and predicted tip on held-out trajectories, with the effects that were added
/// until this step [m].
struct PoseStep {
  std::string effect;            ///< effect that was added last; empty: none yet
  double rms = 0.0;              ///< RMS of the distance
  stats::Interval interval;      ///< 95 % interval of `rms`, by a bootstrap of trajectories
  std::array<double, 3> axis{};  ///< RMS along each axis
  double median = 0.0;           ///< median of the distance
};

/// Result of diagnosePoses().
struct PoseReport {
  Report report;
  PoseReference towards = PoseReference::kKinematics;
  std::size_t fitted = 0, held_out = 0;  ///< number of fitted and of held-out trajectories
  std::vector<PoseStep> steps;           ///< the first one without effects
};

/// Explains the differences between observed tip positions and the reference (kinematics or commands) by
/// effects of pose_hypotheses.h. The effects are selected and fitted on four trajectories in five
/// (pose_selection.h); the other trajectories are held out and show how much each effect lowers the error.
/// Only positions are compared. The tool's orientation is used for `marker_offset` alone, and the rotation of
/// the registration follows from positions.
///
/// The report's channels are the held-out observations: tip x, y, z of frame 0. In each channel, "nominal"
/// and "refitted" are the residual without effects, because there is nothing to refit; the times of the
/// trajectories follow each other. Noise is noiseOf() the final residual. If the reference is the kinematics,
/// the extended robot of the report is `nominal` with the effects of the cameras. Throws base::InputError as
/// motionsOf(), and for a name in `only` that is not in poseHypotheses().
PoseReport diagnosePoses(const PoseEvidence& evidence, const robot::Description& nominal,
                         const PoseOptions& options = {}, base::Progress* progress = nullptr);
inline constexpr std::size_t kHeldOut = 5;  ///< every so many trajectories, one is held out

/// One row per step, in millimetres.
base::Table poseStepTable(const PoseReport& report);
/// jsonOf(Report), extended by "towards", "trajectories": {"fitted", "held_out"} and "steps": [{"effect",
/// "rms", "interval", "axis", "median"}].
nlohmann::json jsonOf(const PoseReport& report);

}  // namespace capstan::diagnosis
