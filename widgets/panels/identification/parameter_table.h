#pragma once

#include <QTreeWidget>
#include <vector>

#include "core/identification/live_identification.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// One line per parameter: name, value ± σ, change from the robot file, and below it a thin bar that shows
/// the progress of σ towards its goal. A settled parameter has a tick.
class ParameterTable : public QTreeWidget {
  Q_OBJECT

 public:
  explicit ParameterTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showRows(const std::vector<identification::LiveRow>& rows);
  /// Index of the selected line, or -1.
  int chosen() const;
  void choose(int row);
  /// Text of a line: "✓ r_l1 59.02 ±0.02 mm −6.5 %".
  QString text(int row) const;
  QSize minimumSizeHint() const override { return {200, 48}; }
  QSize sizeHint() const override;

 signals:
  void chosenChanged();

 protected:
  void drawRow(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override;

 private:
  QString estimateText(const identification::LiveRow& row) const;
  void fill(QTreeWidgetItem& item, const identification::LiveRow& row) const;

  Theme theme_ = Theme::dark();
  std::vector<identification::LiveRow> rows_;
};

}  // namespace capstan::widgets
