#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/diagnosis/hypotheses/pose_model.h"
#include "core/robot/effects.h"

namespace capstan::diagnosis {

/// A cause that poses alone can show. Those that a robot file knows carry its name and words, the others
/// have their own. Zero is nominal for all of their numbers.
struct PoseHypothesis {
  std::string_view name;
  const HypothesisWords* words = nullptr;
  const std::vector<robot::EffectParameter>* parameters = nullptr;
  double scale = 0.0;  ///< of each number: large [its unit]
  double start = 0.0;  ///< where a fit begins, where zero has no slope
  void (*set)(PoseNumbers& numbers, std::span<const double> values) = nullptr;

  std::size_t size() const { return parameters->size(); }
};

/// camera_offset, camera_rotation, camera_scale, insertion_offset, tip_gap; marker_offset, where there are
/// orientations; camera_latency where kinematics are the reference, command_delay and following_lag where
/// the command is.
std::vector<PoseHypothesis> poseHypotheses(PoseReference reference, bool turns);

/// Words of an effect, of the robot's library or of poses; null: none of this name.
const HypothesisWords* wordsOf(std::string_view effect);

}  // namespace capstan::diagnosis
