#include "widgets/panels/learning/stages_view.h"

#include <QBoxLayout>
#include <QHeaderView>
#include <QSplitter>
#include <QTreeWidgetItemIterator>
#include <cmath>

#include "widgets/figures/share_bar.h"
#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/learning/stage_rows.h"
#include "widgets/panels/work/figure_sheet.h"

namespace capstan::widgets {

namespace {

constexpr double kStagesFont = 10.0;
constexpr int kStagesBeside = 860;  ///< width from which on the figure stands beside the table [px]
constexpr int kShareWidth = 72;     ///< [px]

QString shareText(double share) {
  const double percent = 100.0 * share;
  return QString::number(percent, 'f', percent > 0.0 && percent < 9.95 ? 1 : 0) + QStringLiteral(" %");
}

}  // namespace

StagesView::StagesView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->addWidget(split_ = new QSplitter);
  split_->setChildrenCollapsible(false);
  split_->addWidget(rows_ = new QTreeWidget);
  split_->addWidget(lag_ = new FigureSheet);
  rows_->setObjectName("stages");
  rows_->setColumnCount(kColumns);
  rows_->setHeaderHidden(true);
  rows_->setRootIsDecorated(false);
  rows_->setItemsExpandable(false);
  rows_->setIndentation(10);
  rows_->setUniformRowHeights(true);
  rows_->setFrameShape(QFrame::NoFrame);
  rows_->setAllColumnsShowFocus(true);
  rows_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  rows_->setAccessibleName(tr("stages of learning"));
  rows_->setItemDelegateForColumn(kShare, new ShareBar(rows_));
  rows_->header()->setStretchLastSection(false);
  rows_->header()->setMinimumSectionSize(10);
  rows_->header()->setSectionResizeMode(kName, QHeaderView::Stretch);
  rows_->header()->setSectionResizeMode(kValue, QHeaderView::ResizeToContents);
  rows_->header()->setSectionResizeMode(kShare, QHeaderView::Fixed);
  rows_->header()->resizeSection(kShare, kShareWidth);
}

void StagesView::setTheme(const Theme& theme) {
  theme_ = theme;
  lag_->setTheme(theme);
  rows_->setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 1px 4px; } "
                                      "QTreeWidget::item:selected { background: %1; color: %2; }")
                           .arg(theme.raised.name(), theme.text.name()));
  fill();
}

void StagesView::showResults(const LearningResults& results) {
  const bool other = results.stages != results_.stages;
  results_ = results;
  if (other)
    lag_->setFigure(results.stages ? std::make_unique<ClockOffsetFigure>(clockOffsetData(*results.stages))
                                   : nullptr);
  fill();
}

void StagesView::fill() {
  rows_->clear();
  for (const StageGroup& group : stageGroups(results_)) {
    auto* head = new QTreeWidgetItem(rows_, {group.title});
    head->setFlags(Qt::ItemIsEnabled);
    head->setFont(kName, textFont(kStagesFont, true));
    head->setFirstColumnSpanned(true);
    for (const StageRow& row : group.rows) {
      auto* item = new QTreeWidgetItem(head, {row.name, row.value});
      item->setFont(kName, textFont(kStagesFont - 0.5));
      item->setFont(kValue, numberFont(kStagesFont - 0.5));
      item->setFont(kShare, numberFont(kStagesFont - 1.0));
      item->setTextAlignment(kValue, Qt::AlignRight | Qt::AlignVCenter);
      item->setTextAlignment(kShare, Qt::AlignRight | Qt::AlignVCenter);
      item->setToolTip(kName, row.tip.isEmpty() ? row.name.trimmed() : row.tip);
      item->setToolTip(kValue, row.tip.isEmpty() ? row.value : row.tip);
      if (row.rejected) item->setForeground(kName, theme_.muted);
      if (std::isnan(row.share)) continue;
      item->setText(kShare, shareText(row.share));
      ShareBar::set(*item, kShare, row.share, row.rejected ? theme_.warning : theme_.accent);
    }
  }
  rows_->expandAll();
}

void StagesView::resizeEvent(QResizeEvent* event) {
  LearningView::resizeEvent(event);
  const bool beside = width() >= kStagesBeside;
  const Qt::Orientation desired = beside ? Qt::Horizontal : Qt::Vertical;
  if (split_->orientation() != desired || event->oldSize().width() <= 0) {
    split_->setOrientation(desired);
    split_->setSizes(beside ? QList<int>{58 * width() / 100, 42 * width() / 100}
                            : QList<int>{62 * height() / 100, 38 * height() / 100});
  }
}

QStringList StagesView::lines() const {
  QStringList lines;
  for (QTreeWidgetItemIterator it(rows_); *it; ++it)
    lines << (*it)->text(kName).trimmed() + QStringLiteral(" | ") + (*it)->text(kValue);
  return lines;
}

}  // namespace capstan::widgets
