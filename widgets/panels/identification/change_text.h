#pragma once

#include <QString>
#include <vector>

#include "core/identification/estimate.h"
#include "core/identification/model_error.h"
#include "core/identification/parameters.h"
#include "core/robot/description.h"

namespace capstan::widgets {

/// Changes as "r_l1  drives[0].link_radius\n  63.095 → 59.021 ±0.020 mm, −6.46 %". `estimates`: the σ of the
/// values; without them no σ is shown.
QString changesText(const std::vector<identification::RobotChange>& changes,
                    const std::vector<identification::Estimate>& estimates);
/// Table of the model's errors, camera minus model, before and after: a line per joint, in degrees or
/// millimetres.
QString errorsText(const identification::ModelError& error, const robot::Description& robot);

/// Tooltip of the button Accept: what `estimates` identify, and why the other parameters keep their values.
QString acceptTip(const std::vector<identification::Estimate>& estimates);

}  // namespace capstan::widgets
