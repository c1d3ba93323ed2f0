#pragma once

#include <QImage>
#include <QObject>
#include <QTimer>
#include <functional>
#include <vector>

#include "core/learning/model/confidence_slice.h"
#include "widgets/panels/learning/learning_work.h"

namespace capstan::widgets {

/// Figures and tables of what was learned, as files of a folder. Figures, which are widgets, are drawn on the
/// window's thread, one each time nothing else waits.
class LearningExport : public QObject {
  Q_OBJECT

 public:
  explicit LearningExport(QObject* parent = nullptr);

  /// What there is of: rejected.csv; lag, errors (clean and all), curve and the trajectory `which` (−1: none)
  /// as PDF, SVG, PNG and CSV; ablation (clean and all) as CSV and Markdown; `clouds` and the figure of the
  /// confidence where they are given. Files of these names are replaced. Only if not busy().
  void start(const LearningResults& results, int which, const learning::ConfidenceSlice* slice,
             const QImage& clouds, const QString& folder);
  /// What is written already stays.
  void cancel();
  bool busy() const { return !steps_.empty(); }
  const QString& folder() const { return folder_; }

 signals:
  void progressed(double fraction, const QString& doing);
  /// It is no longer busy. `written`: all of it; `words`: what was, or why not.
  void ended(bool written, const QString& words);

 private:
  struct Step {
    QString name;
    std::function<std::size_t()> write;  ///< gives the number of files
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
