#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// The causes of a report, in the report's order: title and joint, posterior probability as a bar, and below
/// each its parameters ± σ, how far it moves the joints and the tip, and how much the residual falls. Causes
/// that cannot be distinguished are in one group. Effects that are also measurable are in a folded group at
/// the end; a click, Return or the space bar unfolds it.
class CauseTree : public QTreeWidget {
  Q_OBJECT

 public:
  explicit CauseTree(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);
  /// The selected cause, of a selected group its first one; null: none.
  const diagnosis::Cause* chosen() const;
  /// Shows or hides the effects that are also measurable.
  void setUnfolded(bool unfolded);
  bool unfolded() const { return unfolded_; }
  /// Everything as indented text, one line per item, folded ones included: for tests and the clipboard.
  QString text() const;
  QSize sizeHint() const override { return {320, 150}; }
  QSize minimumSizeHint() const override { return {180, 60}; }

 signals:
  void chosenChanged();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void fill();
  void addCause(QTreeWidgetItem* parent, std::size_t index);
  QTreeWidgetItem* addTitle(QTreeWidgetItem* parent, const diagnosis::Cause& cause);
  QTreeWidgetItem* addLine(QTreeWidgetItem* parent, const QString& words);

  Theme theme_ = Theme::dark();
  diagnosis::Verdict verdict_ = diagnosis::Verdict::kNothing;
  robot::Description robot_;
  /// Causes in the order of the report, a tied one with its competing explanations, and effects that are
  /// also measurable: in the order of the list.
  std::vector<diagnosis::Cause> causes_;
  std::vector<std::size_t> groups_;  ///< number of causes of each group; more than one: a tie
  QString also_;                     ///< heading of the folded group; empty: there is none
  QTreeWidgetItem* folded_ = nullptr;
  bool unfolded_ = false;
};

}  // namespace capstan::widgets
