#pragma once

#include <QObject>
#include <QTimer>
#include <memory>

#include "widgets/figures/diagnosis_export.h"

namespace capstan::widgets {

/// Exports a report as a page with figures, JSON and robot file. Figures are widgets, so they are drawn on
/// the window's thread, one at a time, when it is idle.
class ReportExport : public QObject {
  Q_OBJECT

 public:
  explicit ReportExport(QObject* parent = nullptr);

  /// Starts the export; only if not busy(). Throws base::InputError for a folder that DiagnosisExport
  /// refuses.
  void start(const diagnosis::Report& report, const std::string& robot, const QString& folder);
  /// Stops the export. Figures drawn so far stay, with a page that reports the cancel.
  void cancel();
  bool busy() const { return drawing_ != nullptr; }

 signals:
  void progressed(double fraction, const QString& doing);
  /// The export has ended. `index`: path of the page, empty if there is none; `words`: what was written, or
  /// the error.
  void ended(const QString& index, const QString& words);

 private:
  void drawNext();
  void end(const QString& index, const QString& words);

  QString folder_;
  std::unique_ptr<DiagnosisExport> drawing_;
  QTimer next_;
};

}  // namespace capstan::widgets
