#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/diagnosis/hypotheses/pose_model.h"
#include "core/robot/effects.h"

namespace capstan::diagnosis {

/// Hypothesis that tip poses alone can test. An effect that also exists in robot files has the name and texts
/// of its entry in hypotheses(); the other effects have their own. The nominal value of every parameter is 0.
struct PoseHypothesis {
  std::string_view name;
  const HypothesisWords* words = nullptr;
  const std::vector<robot::EffectParameter>* parameters = nullptr;
  double scale = 0.0;  ///< large value of each parameter [its unit]
  double start = 0.0;  ///< start value of a fit; not 0 if the residual's derivative is 0 there
  void (*set)(PoseNumbers& numbers, std::span<const double> values) = nullptr;

  std::size_t size() const { return parameters->size(); }
};

/// Pose hypotheses: camera_offset, camera_rotation, camera_scale, insertion_offset, tip_gap; marker_offset if
/// there are orientations (`turns`); camera_latency if the reference is the kinematics, command_delay and
/// following_lag if it is the command.
std::vector<PoseHypothesis> poseHypotheses(PoseReference reference, bool turns);

/// Texts of an effect of either library, hypotheses() or poseHypotheses(); null: no effect of this name.
const HypothesisWords* wordsOf(std::string_view effect);

}  // namespace capstan::diagnosis
