#include "widgets/panels/learning/trajectory_view.h"

#include <QBoxLayout>
#include <QHeaderView>
#include <QShortcut>
#include <QSplitter>

#include "widgets/figures/share_bar.h"
#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/work/figure_sheet.h"

namespace capstan::widgets {

using learning::TrajectoryStates;

namespace {

enum Role { kSortRole = Qt::UserRole + 1, kMotionRole };
constexpr double kTrajectoryFont = 9.5;
constexpr int kTrajectoryBeside = 760, kList = 300;  ///< [px]

/// List item that is sorted by the values of its cells, not by their texts.
class TrajectoryItem : public QTreeWidgetItem {
 public:
  using QTreeWidgetItem::QTreeWidgetItem;
  bool operator<(const QTreeWidgetItem& other) const override {
    const int column = treeWidget() ? treeWidget()->sortColumn() : 0;
    return data(column, kSortRole).toDouble() < other.data(column, kSortRole).toDouble();
  }
};

}  // namespace

TrajectoryView::TrajectoryView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->addWidget(split_ = new QSplitter(Qt::Horizontal));
  split_->setChildrenCollapsible(false);
  split_->addWidget(list_ = new QTreeWidget);
  split_->addWidget(sheet_ = new FigureSheet);
  split_->setStretchFactor(0, 0);
  split_->setStretchFactor(1, 1);
  list_->setObjectName("trajectories");
  list_->setColumnCount(kColumns);
  list_->setHeaderLabels({tr("trajectory"), tr("states"), tr("rejected"), tr("held")});
  list_->headerItem()->setToolTip(kRejected, tr("Share of the trajectory's states that cleaning rejects"));
  list_->headerItem()->setToolTip(kHeld, tr("Held out of training: its errors are those of new motions"));
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setFrameShape(QFrame::NoFrame);
  list_->setAllColumnsShowFocus(true);
  list_->setSortingEnabled(true);
  list_->setMinimumWidth(250);
  list_->setAccessibleName(tr("trajectories"));
  list_->setItemDelegateForColumn(kRejected, new ShareBar(list_));
  list_->header()->setStretchLastSection(false);
  list_->header()->setMinimumSectionSize(10);
  list_->header()->setFont(textFont(9.0));
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(kName, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(kRejected, QHeaderView::Fixed);
  list_->header()->resizeSection(kRejected, 72);
  for (const int at : {kStates, kRejected})
    list_->headerItem()->setTextAlignment(at, Qt::AlignRight | Qt::AlignVCenter);
  connect(list_, &QTreeWidget::currentItemChanged, this, &TrajectoryView::draw);
  const auto key = [this](const char* sequence, int by) {
    connect(new QShortcut(QKeySequence(QString::fromLatin1(sequence)), this), &QShortcut::activated, this,
            [this, by] { step(by); });
  };
  key("Alt+Down", 1);
  key("Alt+Up", -1);
}

void TrajectoryView::setTheme(const Theme& theme) {
  theme_ = theme;
  sheet_->setTheme(theme);
  list_->setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 2px 4px; } "
                                      "QTreeWidget::item:selected { background: %1; color: %2; }")
                           .arg(theme.raised.name(), theme.text.name()));
  fill();
}

void TrajectoryView::showResults(const LearningResults& results) {
  results_ = results;
  fill();
}

int TrajectoryView::chosen() const {
  const QTreeWidgetItem* item = list_->currentItem();
  return item ? item->data(kName, kMotionRole).toInt() : -1;
}

void TrajectoryView::fill() {
  const int before = chosen();
  {
    const QSignalBlocker quiet(list_);
    list_->setSortingEnabled(false);
    list_->clear();
    const std::size_t count = results_.stages ? results_.stages->motions.size() : 0;
    QTreeWidgetItem* current = nullptr;
    for (std::size_t k = 0; k < count; ++k) {
      const TrajectoryStates& motion = results_.stages->motions[k];
      const double share = static_cast<double>(motion.rejected) / static_cast<double>(motion.states());
      const bool held = results_.evaluation && results_.evaluation->held[motion.motion];
      auto* item = new TrajectoryItem;
      const QString name = QString::fromStdString(results_.stages->screen.motions[motion.motion].name);
      item->setText(kName, QString(name).remove(QStringLiteral("trajectory ")));
      item->setText(kStates, countText(motion.states()));
      item->setText(kRejected, QString::number(100.0 * share, 'f', 0) + QStringLiteral(" %"));
      item->setText(kHeld, held ? QStringLiteral("●") : QString());
      item->setTextAlignment(kHeld, Qt::AlignCenter);
      const double keys[] = {static_cast<double>(k), static_cast<double>(motion.states()), share,
                             held ? 1.0 : 0.0};
      for (int at = 0; at < kColumns; ++at) {
        item->setData(at, kSortRole, keys[at]);
        item->setFont(at, at == kName ? textFont(kTrajectoryFont) : numberFont(kTrajectoryFont - 0.5));
        if (at == kStates || at == kRejected) item->setTextAlignment(at, Qt::AlignRight | Qt::AlignVCenter);
      }
      item->setData(kName, kMotionRole, static_cast<int>(k));
      item->setToolTip(kName, name);
      ShareBar::set(*item, kRejected, share, theme_.warning);
      list_->addTopLevelItem(item);
      if (static_cast<int>(k) == before || !current) current = item;
    }
    list_->setColumnHidden(kHeld, !results_.evaluation);
    list_->setSortingEnabled(true);
    if (list_->header()->sortIndicatorSection() >= kColumns || before < 0)
      list_->sortByColumn(kName, Qt::AscendingOrder);
    list_->setCurrentItem(current);
  }
  draw();
}

void TrajectoryView::step(int by) {
  const int at = list_->indexOfTopLevelItem(list_->currentItem()) + by;
  if (at >= 0 && at < list_->topLevelItemCount()) list_->setCurrentItem(list_->topLevelItem(at));
}

void TrajectoryView::showEvent(QShowEvent* event) {
  LearningView::showEvent(event);
  if (stale_) draw();
}

/// Gives the figure the remaining room: beside the list, or below it.
void TrajectoryView::resizeEvent(QResizeEvent* event) {
  LearningView::resizeEvent(event);
  const bool beside = width() >= kTrajectoryBeside;
  const Qt::Orientation desired = beside ? Qt::Horizontal : Qt::Vertical;
  if (split_->orientation() == desired && event->oldSize().width() > 0) return;
  split_->setOrientation(desired);
  split_->setSizes(beside ? QList<int>{kList, width() - kList}
                          : QList<int>{28 * height() / 100, 72 * height() / 100});
}

void TrajectoryView::draw() {
  stale_ = !isVisible();
  const int which = chosen();
  if (which < 0 || !results_.stages) return sheet_->setFigure(nullptr);
  if (stale_) return;
  sheet_->setFigure(std::make_unique<PoseTraceFigure>(
      traceData(*results_.stages, results_.evaluation.get(), static_cast<std::size_t>(which))));
}

}  // namespace capstan::widgets
