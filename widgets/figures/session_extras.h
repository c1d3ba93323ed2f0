#pragma once

#include "widgets/figures/export_all.h"
#include "widgets/figures/joint_history.h"

namespace capstan::widgets {

/// What the export of one session has beside the figures and tables of its errors: the joint plots of
/// `history` over its whole time (NAME-joints), the tables of the record, and its settings. `history` must
/// outlive the export.
ExportExtras sessionExtras(const analysis::SessionRecord& record, const JointHistory& history);

}  // namespace capstan::widgets
