#pragma once

#include <QImage>
#include <functional>
#include <vector>

#include "core/learning/model/confidence_slice.h"
#include "widgets/jobs/step_export.h"
#include "widgets/panels/learning/learning_work.h"

namespace capstan::widgets {

/// Exports figures and tables of the learning results. The result is the path of the folder.
class LearningExport : public StepExport {
  Q_OBJECT

 public:
  explicit LearningExport(QObject* parent = nullptr) : StepExport(parent) {}

  /// Writes those of the following that have results: rejected.csv; lag, errors (clean and all), reliability,
  /// curve and trajectory `which` (−1: none) as PDF, SVG, PNG and CSV; ablation (clean and all) as CSV and
  /// Markdown; `clouds` and the figure of the confidence `slice` if given. Files of the same names are
  /// replaced. Only if not busy().
  void start(const LearningResults& results, int which, const learning::ConfidenceSlice* slice,
             const QImage& clouds, const QString& folder);
  /// Stops the export; files written so far stay.
  void cancel() { endCancelled(folder_); }
  bool busy() const override { return !steps_.empty(); }

 protected:
  void step() override;
  void drop() override { steps_.clear(); }

 private:
  struct Step {
    QString name;
    std::function<std::size_t()> write;  ///< returns the number of files
  };
  void addTables(const LearningResults& results, const std::string& base);
  void addFigures(const LearningResults& results, int which, const std::string& base);

  QString folder_;
  std::vector<Step> steps_;
  std::size_t at_ = 0, files_ = 0;
};

}  // namespace capstan::widgets
