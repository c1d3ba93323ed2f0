#pragma once

#include <QString>
#include <limits>
#include <vector>

#include "widgets/panels/learning/learning_work.h"

/// One stage of learning as a line of a table.
namespace capstan::widgets {

struct StageRow {
  QString name, value;
  double share = std::numeric_limits<double>::quiet_NaN();  ///< share of the rows or states; NaN: none
  bool rejected = false;                                    ///< the line counts excluded rows or states
  QString tip = {};
};

struct StageGroup {
  QString title;
  std::vector<StageRow> rows;
};

/// The stages that have results.
std::vector<StageGroup> stageGroups(const LearningResults& results);

}  // namespace capstan::widgets
