#pragma once

#include <QString>
#include <QStringList>
#include <functional>

#include "core/base/progress.h"
#include "core/diagnosis/report/report.h"

class QSettings;

namespace capstan::widgets {

/// Input of a diagnosis. The settings keep tolerance and effort only: recordings of an earlier day, their
/// units and their robot would pass for those that are open now.
struct DiagnosisChoice {
  QStringList recordings = {};  ///< recordings of one robot, or one table of tip poses: absolute paths
  QString robot = {};           ///< robot file; empty: the recordings' own, or the left RAVEN-II
  /// Units of tables, as recording::parseReadAs() takes them; empty: SI.
  QString read_as = {};
  /// Displacement from which on an effect is a cause, as parseTolerance() reads it. Tables of tip poses do
  /// not use it.
  QString material = QString::fromStdString(diagnosis::formatTolerance({}));

  /// Multiplies the limit of the search for causes (DiagnosisOptions::effort). Tables of tip poses do not use
  /// it.
  double effort = 1.0;

  bool operator==(const DiagnosisChoice&) const = default;
  /// Adds those of `files` that are not in `recordings` yet.
  void add(const QStringList& files);
  void save(QSettings& settings) const;
  static DiagnosisChoice restore(const QSettings& settings);
};

/// Reads files and returns a report, in the background; throws base::InputError.
using DiagnosisRun = std::function<diagnosis::Report(const DiagnosisChoice&, base::Progress&)>;

/// Tolerance of a choice. Throws base::InputError as diagnosis::parseTolerance() does.
diagnosis::Tolerance toleranceOf(const QString& material);

/// Runs diagnosis::diagnoseFiles() on the choice, as capstan-cli diagnose does.
diagnosis::Report runDiagnosis(const DiagnosisChoice& choice, base::Progress& progress);

}  // namespace capstan::widgets
