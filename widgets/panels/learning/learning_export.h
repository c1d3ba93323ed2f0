#pragma once

#include <QImage>
#include <QObject>
#include <QTimer>
#include <functional>
#include <vector>

#include "core/learning/model/confidence_slice.h"
#include "widgets/panels/learning/learning_work.h"

namespace capstan::widgets {

/// Exports figures and tables of the learning results into a folder. Figures are widgets, so they are drawn
/// on the window's thread, one at a time, when it is idle.
class LearningExport : public QObject {
  Q_OBJECT

 public:
  explicit LearningExport(QObject* parent = nullptr);

  /// Writes those of the following that have results: rejected.csv; lag, errors (clean and all), reliability,
  /// curve and trajectory `which` (−1: none) as PDF, SVG, PNG and CSV; ablation (clean and all) as CSV and
  /// Markdown; `clouds` and the figure of the confidence `slice` if given. Files of the same names are
  /// replaced. Only if not busy().
  void start(const LearningResults& results, int which, const learning::ConfidenceSlice* slice,
             const QImage& clouds, const QString& folder);
  /// Stops the export; files written so far stay.
  void cancel();
  bool busy() const { return !steps_.empty(); }
  const QString& folder() const { return folder_; }

 signals:
  void progressed(double fraction, const QString& doing);
  /// The export has ended. `written`: everything was written; `words`: the number of files, or the error.
  void ended(bool written, const QString& words);

 private:
  struct Step {
    QString name;
    std::function<std::size_t()> write;  ///< returns the number of files
  };
  void addTables(const LearningResults& results, const std::string& base);
  void addFigures(const LearningResults& results, int which, const std::string& base);
  void next();
  void end(bool written, const QString& words);

  QString folder_;
  std::vector<Step> steps_;
  std::size_t at_ = 0, files_ = 0;
  QTimer timer_;
};

}  // namespace capstan::widgets
