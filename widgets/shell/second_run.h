#pragma once

#include <QString>
#include <array>

#include "core/analysis/alignment.h"
#include "core/tracking/track_all.h"
#include "widgets/figures/joint_history.h"

namespace capstan::widgets {

/// A session that was tracked in the background: curves, errors, report and motion.
struct SecondRun {
  QString words;  ///< what it is: a file name, or what is different from the session
  std::array<QString, 3> joint_names;
  JointHistory values, errors;
  tracking::TrackReport report;
  analysis::MotionSeries motion;
};

}  // namespace capstan::widgets
