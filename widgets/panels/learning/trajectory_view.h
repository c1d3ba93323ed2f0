#pragma once

#include <QTreeWidgetItem>

#include "widgets/panels/learning/learning_view.h"

class QSplitter;
class QTreeWidget;

namespace capstan::widgets {

class FigureSheet;

/// List of trajectories with the share of rejected states of each, and the selected one over time; Alt+Down
/// and Alt+Up select the next and the previous.
class TrajectoryView : public LearningView {
  Q_OBJECT

 public:
  explicit TrajectoryView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  QTreeWidget& list() { return *list_; }
  FigureSheet& sheet() { return *sheet_; }
  /// Index of the selected trajectory in stages.motions; −1: none.
  int chosen() const;

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  enum Column { kName, kStates, kRejected, kHeld, kColumns };

  void fill();
  void draw();
  void step(int by);

  Theme theme_ = Theme::dark();
  LearningResults results_;
  bool stale_ = false;  ///< the drawing is out of date; it is redrawn when the view is shown
  QSplitter* split_;
  QTreeWidget* list_;
  FigureSheet* sheet_;
};

}  // namespace capstan::widgets
