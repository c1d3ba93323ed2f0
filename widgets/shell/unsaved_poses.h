#pragma once

#include <QString>

class QWidget;

namespace capstan::widgets {

class PosesPage;

/// Property of the application that is true while nobody is there to answer, as when a signal closes it.
inline constexpr const char* kUnattended = "capstan_unattended";

/// Called before the window closes: asks whether the page's unsaved poses are saved or dropped. Where nobody
/// can answer, writes them into `folder`, as unsaved-poses_DATE.csv. Returns false if the window is to stay
/// open.
bool settleUnsavedPoses(PosesPage& page, const QString& folder, QWidget* window);

}  // namespace capstan::widgets
