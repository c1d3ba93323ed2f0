#pragma once

#include <QTimer>

#include "core/learning/model/confidence_slice.h"
#include "widgets/jobs/job.h"
#include "widgets/panels/learning/learning_view.h"

class QComboBox;
class QLabel;
class QSlider;

namespace capstan::widgets {

class FigureSheet;

/// Confidence of the correction over a plane of the workspace, of selectable axis and depth; Alt+A selects
/// the next axis. Computed in the background as soon as there is a correction.
class ConfidenceView : public LearningView {
  Q_OBJECT

 public:
  explicit ConfidenceView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  QComboBox& axis() { return *axis_; }
  QSlider& depth() { return *depth_; }
  FigureSheet& sheet() { return *sheet_; }
  /// The slice shown; null: none yet.
  const learning::ConfidenceSlice* slice() const;

 private:
  void ask();
  void compute();

  std::shared_ptr<const learning::LearningReport> learned_;
  bool stale_ = false;  ///< the slice shown is not yet the chosen one
  QComboBox* axis_;
  QSlider* depth_;
  QLabel* words_;
  FigureSheet* sheet_;
  QTimer soon_;  ///< delays the computation while the slider moves
  Job job_;      ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
