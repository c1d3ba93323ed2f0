#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/recording/measured_table.h"
#include "core/tracking/source.h"

namespace capstan::diagnosis {

/// Evidence of a measured table, on a grid of rows with a constant time step (even_grid.h). A row that lies
/// on the grid keeps its numbers to the last bit. Elsewhere motor data are interpolated linearly, and a joint
/// encoder's reading is moved to the nearest row along the slope between its neighbours. Columns p_c give tip
/// observations at the times of their rows. Columns q are excluded if the robot computed them from its
/// motors.
///
/// `robot` gives the drive, the number of joints, the motors' torque limits, and the kinematics that separate
/// the tips' noise from motion. Throws base::InputError with file, column and remedy if there are neither
/// joint encoders nor camera tips; if q_m (cable drive) or tau_m (rigid drive) is missing; if the number of
/// joints is not the robot's; with fewer than kFewestRows rows that are not excluded; and with both fewer
/// encoder readings than kFewestRows and fewer observations than kFewestObservations.
Evidence evidenceOf(const recording::MeasuredTable& table, const robot::Description& robot,
                    const EvidenceOptions& options = {});

/// Evidence of a recording of a three-joint arm with a cable drive, on the grid of its motor samples. Tips
/// are the tip positions of the tracking pipeline with the recording's own options: from the images, or from
/// the recording if it has none. Tips that its gate rejects are included and judged by judgeObservations().
/// The robot is the source's. Throws as above. If `progress` is cancelled, the evidence holds the samples
/// read until then.
Evidence evidenceOf(tracking::Source& source, const EvidenceOptions& options = {},
                    base::Progress* progress = nullptr);

/// Evidence of a file: a session, a recording of the RAVEN-II's own software, or a measured table. `robot` is
/// used for recordings that contain no robot. Throws recording::ImplausibleUnits and base::InputError as the
/// readers do, and as above.
Evidence readEvidence(const std::filesystem::path& path, const robot::Description& robot,
                      const EvidenceOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::diagnosis
