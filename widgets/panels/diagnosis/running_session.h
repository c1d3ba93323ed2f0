#pragma once

#include <QString>

#include "widgets/panels/diagnosis/diagnosis_choice.h"

namespace capstan::widgets {

/// Session that runs in the window, whose robot the extended robot may replace.
struct RunningSession {
  int joints = 0;          ///< number of joints of its robot; 0: no session
  QString arm = {};        ///< name of its robot
  QString recording = {};  ///< recording that is open; empty: simulated or live
};

/// Button that lets the session use an extended robot.
struct UseOffer {
  bool enabled = false;
  QString words;  ///< of the button; names the recordings of the diagnosis if another one is open
  QString tip;    ///< what the button does, or why it does nothing
};

/// Offer of the extended robot of a report on the recordings `of`.
UseOffer useOffer(const diagnosis::Report& report, const DiagnosisChoice& of, const RunningSession& session);

/// File names of recordings: "slow.csv, fast.csv".
QString fileNamesOf(const QStringList& paths);

}  // namespace capstan::widgets
