#pragma once

#include "widgets/panels/learning/learning_view.h"

class QSplitter;
class QTreeWidget;

namespace capstan::widgets {

class FigureSheet;

/// Every stage with its numbers: what was excluded and why, lag, velocities, offset, process, errors. Beside
/// them the misfit against the lag.
class StagesView : public LearningView {
  Q_OBJECT

 public:
  explicit StagesView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  /// "lag behind the command, ± σ | 87.2 ± 1.1 ms", line by line.
  QStringList lines() const;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();

  Theme theme_ = Theme::dark();
  LearningResults results_;
  QSplitter* split_;
  QTreeWidget* rows_;
  FigureSheet* lag_;
};

}  // namespace capstan::widgets
