#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/experiments/debridement_scene.h"
#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"
#include "core/simulation/tool_truth.h"

/// Training of a correction on a simulated arm, as on a real one: from recorded poses to states to a model.
namespace capstan::experiments {

/// Defaults are the GPR paper's (section V-B) but for `margin` and rotations: what cameras see is centimetres
/// and some ten degrees off, and desired poses are to lie among observed ones. Learned is by the options of
/// learning::learn(), but cleaned as in the paper and without weights.
struct TrainingOptions {
  int motions = 303;
  double speed = 0.05;      ///< [m/s]
  double rest = 0.2;        ///< before and after each motion, recorded too [s]
  double margin = 0.03;     ///< around the grid [m]
  double most_yaw = 0.6;    ///< about the jaws' direction [rad]
  double most_tilt = 0.45;  ///< about both axes across it [rad]
  learning::CleaningOptions cleaning;
  learning::CorrectionOptions correction{.motion = std::nullopt};
  std::uint64_t seed = 1;
};

/// base::InputError: options that make no sense.
void checkTraining(const TrainingOptions& options);

/// The arm with its native controller alone, from place to place at random, uncorrected: a motion each, with
/// what cameras, nominal kinematics and commands said. Fewer when cancelled. base::InputError as
/// checkTraining.
std::vector<learning::RawMotion> recordTraining(const robot::Description& robot,
                                                const simulation::ToolTruth& truth,
                                                const TrainingOptions& options,
                                                const base::Progress* progress = nullptr);

struct TrainedCorrection {
  learning::CorrectionModel model;
  std::size_t motions = 0, rows = 0;  ///< recorded; poses of cameras
  std::size_t screened = 0;           ///< of them, excluded as no poses
  std::size_t states = 0, kept = 0;   ///< paired with commands; after cleaning
  double clock_offset = 0.0;          ///< of cameras behind commands [s]
};

/// screenPoses → clockOffsetBetween commands and cameras → statesOf → cleanStates → CorrectionModel::trained.
/// base::InputError: too few states are left. Cancelled: a rigid offset alone.
TrainedCorrection trainedOn(const std::vector<learning::RawMotion>& motions, const TrainingOptions& options,
                            base::Progress* progress = nullptr);

}  // namespace capstan::experiments
