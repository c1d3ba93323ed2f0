#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// The causes that a report names, the likeliest first: title and joint, probability as a bar, below each its
/// numbers ± σ and what it is worth. Those that cannot be distinguished stand together, with the motion that
/// would part them.
class CauseTree : public QTreeWidget {
  Q_OBJECT

 public:
  explicit CauseTree(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);
  /// The cause that is chosen, as shown: null where none is.
  const diagnosis::Cause* chosen() const;
  /// Everything as text, a line each, indented: for tests and the clipboard.
  QString text() const;
  QSize sizeHint() const override { return {320, 150}; }
  QSize minimumSizeHint() const override { return {180, 60}; }

 signals:
  void chosenChanged();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void fill();
  void wrapNames();  ///< to the width that there is
  void addCause(QTreeWidgetItem* parent, const diagnosis::Cause& cause);
  QTreeWidgetItem* addLine(QTreeWidgetItem* parent, const QString& words);

  Theme theme_ = Theme::dark();
  diagnosis::Verdict verdict_ = diagnosis::Verdict::kNothing;
  robot::Description robot_;
  std::vector<diagnosis::Cause> causes_;  ///< as listed, tied ones too
  std::vector<diagnosis::Tie> ties_;
  std::size_t alone_ = 0;  ///< of causes_, those that are not tied
};

}  // namespace capstan::widgets
