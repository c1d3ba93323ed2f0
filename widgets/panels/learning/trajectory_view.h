#pragma once

#include <QTreeWidgetItem>

#include "widgets/panels/learning/learning_view.h"

class QSplitter;
class QTreeWidget;

namespace capstan::widgets {

class FigureSheet;

/// Trajectories with the share of each that was rejected, and the one chosen over time; Alt+Down and Alt+Up
/// go through them.
class TrajectoryView : public LearningView {
  Q_OBJECT

 public:
  explicit TrajectoryView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  QTreeWidget& list() { return *list_; }
  FigureSheet& sheet() { return *sheet_; }
  /// The one chosen among stages.motions; −1: none.
  int chosen() const;

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();
  void draw();
  void step(int by);

  Theme theme_ = Theme::dark();
  LearningResults results_;
  bool stale_ = false;  ///< drawn when somebody looks
  QSplitter* split_;
  QTreeWidget* list_;
  FigureSheet* sheet_;
};

}  // namespace capstan::widgets
