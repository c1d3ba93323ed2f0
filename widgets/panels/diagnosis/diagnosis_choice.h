#pragma once

#include <QString>
#include <QStringList>
#include <functional>

#include "core/base/progress.h"
#include "core/diagnosis/report/report.h"

class QSettings;

namespace capstan::widgets {

/// What the user wants diagnosed; kept between starts.
struct DiagnosisChoice {
  QStringList recordings = {};  ///< absolute paths, each once
  QString robot = {};           ///< robot file; empty: the recordings' own, or the left RAVEN-II

  bool operator==(const DiagnosisChoice&) const = default;
  /// Adds those of `files` that are not there yet.
  void add(const QStringList& files);
  void save(QSettings& settings) const;
  static DiagnosisChoice restore(const QSettings& settings);
};

/// From files to a report, in the background; throws base::InputError.
using DiagnosisRun = std::function<diagnosis::Report(const DiagnosisChoice&, base::Progress&)>;

/// Reads the recordings and diagnoses them. A robot file that was chosen is the nominal robot, also of
/// recordings that bring one of their own. base::InputError as readEvidence() and diagnose(), and for
/// recordings that bring different robots while none was chosen.
diagnosis::Report runDiagnosis(const DiagnosisChoice& choice, base::Progress& progress);

}  // namespace capstan::widgets
