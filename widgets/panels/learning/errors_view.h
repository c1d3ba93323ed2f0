#pragma once

#include "widgets/panels/learning/learning_view.h"

class QCheckBox;
class QComboBox;
class QLabel;

namespace capstan::widgets {

class FigureSheet;

/// Errors per degree of freedom on held-out trajectories: observed, with the rigid offset, corrected.
class ErrorsView : public LearningView {
  Q_OBJECT

 public:
  explicit ErrorsView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  FigureSheet& sheet() { return *sheet_; }
  QString words() const;

 private:
  void draw();

  std::shared_ptr<const learning::HeldOutEvaluation> evaluation_;
  QLabel* words_;
  QCheckBox* observed_;
  QComboBox* which_;
  FigureSheet* sheet_;
};

}  // namespace capstan::widgets
