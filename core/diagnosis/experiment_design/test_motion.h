#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/robot/description.h"
#include "core/robot/joint_vector.h"

namespace capstan::diagnosis {

/// Joint motion that a person could record, sampled at a constant rate. It starts and ends at rest.
struct TestMotion {
  std::string title;                      ///< "joint 2 sweeps slowly, the other joints rest"
  double step = 0.0;                      ///< time between samples [s]
  std::vector<robot::JointVector> q, dq;  ///< joint positions [rad or m] and velocities

  double duration() const { return step * static_cast<double>(q.size() - 1); }
};

/// The motions from which an experiment is chosen, kTestDuration each: for each joint slow sweeps, fast
/// sweeps, steps with rests and small reversals; for all joints together sinusoids, and fast motion followed
/// by rest. All stay within the range of the recordings, widened by a quarter at either end and
/// limited to the joint limits less a twentieth of their range, and below half of each joint's highest speed.
/// `step` is the time between samples [s].
std::vector<TestMotion> testMotions(const robot::Description& robot, const std::vector<Evidence>& recordings,
                                    double step);
inline constexpr double kTestDuration = 24.0;  ///< [s]

}  // namespace capstan::diagnosis
