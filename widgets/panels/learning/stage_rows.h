#pragma once

#include <QString>
#include <limits>
#include <vector>

#include "widgets/panels/learning/learning_work.h"

/// The stages of learning as lines of a table.
namespace capstan::widgets {

struct StageRow {
  QString name, value;
  double share = std::numeric_limits<double>::quiet_NaN();  ///< of the stage's rows or states; NaN: none
  bool rejected = false;                                    ///< counts what was excluded
  QString tip = {};
};

struct StageGroup {
  QString title;
  std::vector<StageRow> rows;
};

/// Those that there are results of.
std::vector<StageGroup> stageGroups(const LearningResults& results);

}  // namespace capstan::widgets
