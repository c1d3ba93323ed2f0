#pragma once

#include <QString>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// Writes the extended robot of a report to a robot file. Returns whether it was written; `words`: that it
/// was, or why not.
bool saveExtendedRobot(const diagnosis::Report& report, const QString& path, QString& words);

}  // namespace capstan::widgets
