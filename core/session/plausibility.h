#pragma once

#include <string>
#include <vector>

#include "core/robot/description.h"
#include "core/session/measured_table.h"

namespace capstan::session {

/// One line for each column of `table` that a robot like `robot` can hardly have measured, with the unit it
/// may be in instead:
///   t      median period outside 1e-4 … 0.1 s
///   q      outside the limits by more than their range
///   q_m    beyond three times the travel that the joint limits need
///   dq_m   beyond ten times what the joints' highest speeds need
///   p_c    beyond three times the arm's reach
/// No errors: there are other robots. Joint columns count only where the table has as many joints as the
/// robot.
std::vector<std::string> unitDoubts(const MeasuredTable& table, const robot::Description& robot);

}  // namespace capstan::session
