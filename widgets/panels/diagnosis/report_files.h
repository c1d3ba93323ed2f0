#pragma once

#include <QString>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// Writes the extended robot of a report to a robot file. Returns whether it was written; `words`: that it
/// was, or why not.
bool saveExtendedRobot(const diagnosis::Report& report, const QString& path, QString& words);

/// Writes the trajectory of a proposed experiment, in the same way.
bool saveNextExperiment(const diagnosis::NextExperiment& next, const QString& path, QString& words);

}  // namespace capstan::widgets
