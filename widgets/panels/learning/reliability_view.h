#pragma once

#include "widgets/panels/learning/learning_view.h"

namespace capstan::widgets {

class FigureSheet;

/// Reliability of the stated uncertainty of the correction, on held-out trajectories.
class ReliabilityView : public LearningView {
  Q_OBJECT
 public:
  explicit ReliabilityView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  const FigureSheet& sheet() const { return *sheet_; }

 private:
  FigureSheet* sheet_;
  std::shared_ptr<const learning::HeldOutEvaluation> evaluation_;
};

}  // namespace capstan::widgets
