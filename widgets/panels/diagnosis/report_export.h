#pragma once

#include <QObject>
#include <QTimer>
#include <memory>

#include "widgets/figures/diagnosis_export.h"

namespace capstan::widgets {

/// A report as a page with figures, JSON and robot file. Figures, which are widgets, are drawn on the
/// window's thread, one each time nothing else waits.
class ReportExport : public QObject {
  Q_OBJECT

 public:
  explicit ReportExport(QObject* parent = nullptr);

  /// Only if not busy(). Throws base::InputError for a folder that DiagnosisExport refuses.
  void start(const diagnosis::Report& report, const std::string& robot, const QString& folder);
  /// What is drawn already stays, with a page that reports it.
  void cancel();
  bool busy() const { return drawing_ != nullptr; }

 signals:
  void progressed(double fraction, const QString& doing);
  /// It is no longer busy. `index`: the page, empty where there is none; `words`: what was written, or why
  /// not.
  void ended(const QString& index, const QString& words);

 private:
  void drawNext();
  void end(const QString& index, const QString& words);

  QString folder_;
  std::unique_ptr<DiagnosisExport> drawing_;
  QTimer next_;
};

}  // namespace capstan::widgets
