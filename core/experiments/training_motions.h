#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/experiments/debridement_scene.h"
#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"
#include "core/simulation/tool_truth.h"

/// Training of a correction on a simulated arm, in the steps of a real one: recorded poses, states, model.
namespace capstan::experiments {

/// Options of the training. Defaults are those of the GPR paper (section V-B), except `margin` and rotations:
/// observed poses are off by centimetres and about ten degrees, and desired poses must lie among the observed
/// ones. Learning uses the options of learning::learn(), but cleaning is that of the paper, without weights.
struct TrainingOptions {
  int motions = 303;     ///< number of recorded motions
  double speed = 0.05;   ///< speed of the tool [m/s]
  double rest = 0.2;     ///< recorded time at rest before and after each motion [s]
  double margin = 0.03;  ///< margin around the grid of fragments, within which poses are drawn [m]
  static constexpr double kMostYaw = 0.6;  ///< largest rotation about the jaws' direction [rad]
  double most_tilt = 0.45;                 ///< largest rotation about each of the two axes across it [rad]
  learning::CleaningOptions cleaning;
  learning::CorrectionOptions correction{.motion = std::nullopt};
  std::uint64_t seed = 1;
};

/// Throws base::InputError for options out of range.
void checkTraining(const TrainingOptions& options);

/// Records uncorrected motions of the arm with its native controller between random poses. Each motion has
/// the poses of cameras, nominal kinematics and commands. Fewer when cancelled. Throws base::InputError as
/// checkTraining().
std::vector<learning::RawMotion> recordTraining(const robot::Description& robot,
                                                const simulation::ToolTruth& truth,
                                                const TrainingOptions& options,
                                                const base::Progress* progress = nullptr);

struct TrainedCorrection {
  learning::CorrectionModel model;
  std::size_t motions = 0, rows = 0;  ///< numbers of recorded motions and of camera poses
  std::size_t screened = 0;           ///< number of camera rows excluded because they are not poses
  std::size_t states = 0, kept = 0;  ///< numbers of states paired with commands, and of states after cleaning
  double clock_offset = 0.0;         ///< delay of camera stamps against commands [s]
};

/// Trains a correction: screenPoses → clockOffsetBetween commands and cameras → statesOf → cleanStates →
/// CorrectionModel::trained. Throws base::InputError when too few states remain. When cancelled, the model is
/// a rigid offset only.
TrainedCorrection trainedOn(const std::vector<learning::RawMotion>& motions, const TrainingOptions& options,
                            base::Progress* progress = nullptr);

}  // namespace capstan::experiments
