#include "widgets/panels/identification/parameter_table.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>

namespace capstan::widgets {

namespace {

enum Column { kName, kEstimate, kChange, kColumns };
constexpr double kPoints = 8.5;  ///< value ± σ with its unit is whole in the window's narrowest column
constexpr int kRowHeight = 21, kBar = 3;  // [px]

/// Item delegate that reserves room for the bar.
class Rows : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    return {QStyledItemDelegate::sizeHint(option, index).width(), kRowHeight};
  }
};

QString shown(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

ParameterTable::ParameterTable(QWidget* parent) : QTreeWidget(parent) {
  setColumnCount(kColumns);
  setItemDelegate(new Rows(this));
  setHeaderHidden(true);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setFrameShape(QFrame::NoFrame);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);  // no taller than its rows
  setSelectionMode(QAbstractItemView::SingleSelection);
  setAllColumnsShowFocus(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setAccessibleName(tr("identified parameters"));
  header()->setMinimumSectionSize(10);
  header()->setStretchLastSection(false);
  for (const int column : {kName, kChange})
    header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kEstimate, QHeaderView::Stretch);
  connect(this, &QTreeWidget::currentItemChanged, this, [this] { Q_EMIT chosenChanged(); });
  setTheme(theme_);
}

void ParameterTable::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet(QStringLiteral("QTreeWidget::item:selected { background: %1; color: %2; }")
                    .arg(theme.raised.name(), theme.text.name()));
  for (int i = 0; i < topLevelItemCount(); ++i) fill(*topLevelItem(i), rows_[static_cast<std::size_t>(i)]);
  viewport()->update();
}

/// Value ± σ and unit; the signs ± of all rows stand below each other.
QString ParameterTable::estimateText(const identification::LiveRow& row) const {
  if (row.sigma.empty()) return shown(row.value);
  qsizetype widest = 0;
  for (const auto& one : rows_)
    if (!one.sigma.empty()) widest = std::max<qsizetype>(widest, shown(one.value).size());
  return shown(row.value).rightJustified(static_cast<int>(widest)) + QLatin1Char(' ') +
         shown(row.sigma + " " + row.unit);
}

void ParameterTable::fill(QTreeWidgetItem& item, const identification::LiveRow& row) const {
  const QString texts[] = {(row.settled ? tr("✓ ") : QStringLiteral("  ")) + shown(row.name),
                           estimateText(row), shown(row.change)};
  for (int column = 0; column < kColumns; ++column) {
    item.setText(column, texts[column]);
    item.setFont(column, numberFont(kPoints));
    item.setForeground(column, column == kEstimate && row.seen ? theme_.text : theme_.muted);
    item.setTextAlignment(column, (column == kChange ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignTop);
    item.setToolTip(column, shown(row.words));
  }
  item.setForeground(kName, theme_.text);
}

void ParameterTable::showRows(const std::vector<identification::LiveRow>& rows) {
  rows_ = rows;
  const int count = static_cast<int>(rows.size());
  if (count != topLevelItemCount()) updateGeometry();
  while (topLevelItemCount() > count) delete takeTopLevelItem(topLevelItemCount() - 1);
  while (topLevelItemCount() < count) addTopLevelItem(new QTreeWidgetItem);
  for (int i = 0; i < count; ++i) fill(*topLevelItem(i), rows_[static_cast<std::size_t>(i)]);
  if (count > 0 && !currentItem()) choose(0);
  viewport()->update();
}

int ParameterTable::chosen() const { return indexOfTopLevelItem(currentItem()); }

void ParameterTable::choose(int row) { setCurrentItem(topLevelItem(row)); }

QString ParameterTable::text(int row) const {
  QStringList cells;
  for (int column = 0; column < kColumns; ++column) cells << topLevelItem(row)->text(column).trimmed();
  return cells.join(' ').simplified();
}

QSize ParameterTable::sizeHint() const { return {260, kRowHeight * std::max(1, topLevelItemCount()) + 2}; }

void ParameterTable::drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                             const QModelIndex& index) const {
  QTreeWidget::drawRow(painter, option, index);
  const auto& row = rows_[static_cast<std::size_t>(index.row())];
  QRect bar = option.rect;
  bar.setTop(bar.bottom() - kBar);
  bar.setHeight(kBar);
  bar.setRight(viewport()->width() - 1);
  painter->fillRect(bar, theme_.grid);
  bar.setWidth(static_cast<int>(row.share * bar.width()));
  painter->fillRect(bar, row.settled ? theme_.colour(Quantity::kUkf) : theme_.accent);
}

}  // namespace capstan::widgets
