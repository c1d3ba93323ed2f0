#pragma once

#include "widgets/panels/learning/learning_view.h"

class QSplitter;
class QTreeWidget;

namespace capstan::widgets {

class FigureSheet;

/// Every stage of learning with its numbers: rejected data with reasons, lag, velocities, offset, process,
/// errors. Beside them the misfit against the lag.
class StagesView : public LearningView {
  Q_OBJECT

 public:
  explicit StagesView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  /// Rows as text: "lag behind the command, ± σ | 87.2 ± 1.1 ms".
  QStringList lines() const;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  enum Column { kName, kValue, kShare, kColumns };

  void fill();

  Theme theme_ = Theme::dark();
  LearningResults results_;
  QSplitter* split_;
  QTreeWidget* rows_;
  FigureSheet* lag_;
};

}  // namespace capstan::widgets
