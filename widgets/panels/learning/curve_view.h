#pragma once

#include "widgets/panels/learning/learning_view.h"

class QPushButton;

namespace capstan::widgets {

class FigureSheet;

/// Learning curve: error on held-out trajectories against the number of training states.
class CurveView : public LearningView {
  Q_OBJECT

 public:
  explicit CurveView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  void setReady(bool ready);
  FigureSheet& sheet() { return *sheet_; }

 signals:
  void runRequested();

 private:
  std::shared_ptr<const learning::LearningCurve> curve_;
  QPushButton* run_;
  FigureSheet* sheet_;
};

}  // namespace capstan::widgets
