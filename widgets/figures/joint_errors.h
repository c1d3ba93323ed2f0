#pragma once

#include "widgets/figures/joint_history.h"

namespace capstan::widgets {

/// Adds the errors of a snapshot to a history of errors: each joint position minus the true one, the camera's
/// at its own time. The true position is then zero; sigma stays. Where the reference is of another time than
/// the estimates, no row is added; without a reference the errors are NaN.
void appendErrors(JointHistory& errors, tracking::Snapshot snapshot);

}  // namespace capstan::widgets
