#pragma once

#include <QString>

namespace capstan::live {
struct RunStatus;
}

namespace capstan::widgets {

/// Title of the window: "Capstan ─ SOURCE", where SOURCE (titleOf()) names file or robot and whether it is
/// live, simulated or a recording; while it is recorded, with "─ FILE ● REC 03:12". `recorded`: time that the
/// recording has [s]; negative: none is running.
QString titleOfWindow(const QString& source, const live::RunStatus& status, double recorded);

}  // namespace capstan::widgets
