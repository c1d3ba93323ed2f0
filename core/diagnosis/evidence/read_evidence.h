#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/recording/measured_table.h"
#include "core/tracking/source.h"

namespace capstan::diagnosis {

/// The evidence of a measured table. Rows go to the even grid that lies nearest to them: a row on it keeps
/// its numbers to the last bit; between rows the drive is interpolated linearly, and a joint encoder's
/// reading is moved to the nearest row along the line to its neighbours. Columns p_c give tip observations at
/// their rows' times. q that the robot computed from its motors is excluded, as no reference.
///
/// `robot` gives the number of joints, the motors' torque limits, and the kinematics by which the noise of
/// tips is distinguished from motion. Throws base::InputError naming file, column and remedy: neither joint
/// encoders nor camera tips; no q_m for a cable drive, no tau_m for a rigid one; another number of joints
/// than the robot's; a step below the table's own; fewer rows that count than kFewestRows, or fewer
/// observations than kFewestObservations where there are no encoders.
Evidence evidenceOf(const recording::MeasuredTable& table, const robot::Description& robot,
                    const EvidenceOptions& options = {});

/// The evidence of a recording with samples of three-joint arms, on the grid of its motor samples, with the
/// tips that the tracking pipeline of its own options found in pictures (or was given). Tips that its gate
/// calls jumps are kept and judged here. The robot is the source's. Errors as above; cable drives only.
/// Cancelled: what was read until then.
Evidence evidenceOf(tracking::Source& source, const EvidenceOptions& options = {},
                    base::Progress* progress = nullptr);

/// Reads a session file, a recording of the RAVEN-II's own software, or a measured table. `robot` is for
/// recordings that bring none. Throws recording::ImplausibleUnits, base::InputError as the readers and as
/// above.
Evidence readEvidence(const std::filesystem::path& path, const robot::Description& robot,
                      const EvidenceOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::diagnosis
