#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// The causes in a report, the most probable first: title and joint, probability as a bar, and below each its
/// parameters ± σ and its gain. Causes that cannot be distinguished are in one group, with the motion that
/// would distinguish them.
class CauseTree : public QTreeWidget {
  Q_OBJECT

 public:
  explicit CauseTree(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);
  /// The selected cause; null: none.
  const diagnosis::Cause* chosen() const;
  /// Everything as indented text, one line per item: for tests and the clipboard.
  QString text() const;
  QSize sizeHint() const override { return {320, 150}; }
  QSize minimumSizeHint() const override { return {180, 60}; }

 signals:
  void chosenChanged();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void fill();
  void wrapNames();  ///< wraps names to the present width
  void addCause(QTreeWidgetItem* parent, const diagnosis::Cause& cause);
  QTreeWidgetItem* addLine(QTreeWidgetItem* parent, const QString& words);

  Theme theme_ = Theme::dark();
  diagnosis::Verdict verdict_ = diagnosis::Verdict::kNothing;
  robot::Description robot_;
  std::vector<diagnosis::Cause> causes_;  ///< causes in the order of the list, tied ones included
  std::vector<diagnosis::Tie> ties_;
  std::size_t alone_ = 0;  ///< number of causes that are not tied
};

}  // namespace capstan::widgets
