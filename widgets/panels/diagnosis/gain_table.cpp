#include "widgets/panels/diagnosis/gain_table.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/report/shown.h"
#include "widgets/figures/figure_text.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"

namespace capstan::widgets {

namespace {

constexpr double kPoints = 10.0;
constexpr int kEndsRole = Qt::UserRole + 1;  ///< before, its low and high, after, its low and high; 0…1
constexpr int kColoursRole = Qt::UserRole + 2;

/// Draws two values with their intervals, one above the other: before as a square, after as a disc.
class IntervalCell : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QStyledItemDelegate::paint(painter, option, index);
    const QVariantList ends = index.data(kEndsRole).toList(), colours = index.data(kColoursRole).toList();
    if (ends.size() != 6 || colours.size() != 2) return;
    const QRectF cell = QRectF(option.rect).adjusted(8.0, 0.0, -8.0, 0.0);
    const auto x = [&](int i) { return cell.left() + ends[i].toDouble() * cell.width(); };
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    for (int row = 0; row < 2; ++row) {
      const double y = cell.top() + (row == 0 ? 0.3 : 0.7) * cell.height();
      const QColor colour = colours[row].value<QColor>();
      const int first = 3 * row;
      painter->setPen(QPen(colour, 2.0));
      painter->setBrush(colour);
      painter->drawLine(QPointF(x(first + 1), y), QPointF(x(first + 2), y));
      const QRectF mark(x(first) - 3.5, y - 3.5, 7.0, 7.0);
      row == 0 ? painter->drawRect(mark) : painter->drawEllipse(mark);
    }
    painter->restore();
  }
};

QString intervalTip(const stats::Interval& interval, double scale) {
  return QObject::tr("95 %: %1 … %2")
      .arg(significantText(scale * interval.low), significantText(scale * interval.high));
}

}  // namespace

GainTable::GainTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("gain");
  setColumnCount(kColumns);
  setHeaderLabels({tr("RMS error of"), tr("robot file"), tr("refitted"), tr("extended"), tr("left"),
                   tr("■ refitted ● extended")});
  headerItem()->setToolTip(kDrawn, tr("RMS with 95 % intervals; one scale for angles, one for lengths"));
  headerItem()->setToolTip(kLeft,
                           tr("Share of the refitted model's error that is left, with its 95 % interval"));
  setItemDelegateForColumn(kDrawn, new IntervalCell(this));
  setRootIsDecorated(false);
  setItemsExpandable(false);
  setIndentation(10);
  setFrameShape(QFrame::NoFrame);
  setAllColumnsShowFocus(true);
  setAccessibleName(tr("gain of the extended model"));
  header()->setStretchLastSection(false);
  header()->setMinimumSectionSize(10);
  header()->setFont(textFont(9.0));
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kDrawn, QHeaderView::Stretch);
  for (int column = kNominal; column <= kLeft; ++column)
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
}

void GainTable::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 4px 6px; } "
                               "QTreeWidget::item:selected { background: %1; color: %2; }")
                    .arg(theme.raised.name(), theme.text.name()));
  fill();
}

void GainTable::showReport(const diagnosis::Report& report) {
  channels_.clear();
  titles_.clear();
  for (const diagnosis::ChannelReport& channel : report.channels) {
    titles_.push_back(channelTitle(report, channel));
    auto& kept = channels_.emplace_back();
    kept.nominal_statistics = channel.nominal_statistics;
    kept.refitted_statistics = channel.refitted_statistics;
    kept.extended_statistics = channel.extended_statistics;
    kept.gain = channel.gain;
  }
  filter_ = report.filter;
  fill();
}

double GainTable::reachOf(const std::string& unit) const {
  double reach = 0.0;
  for (const diagnosis::ChannelReport& channel : channels_)
    if (channel.gain.unit == unit)
      for (const double value : {channel.gain.rms_before, channel.gain.rms_after, channel.gain.before.high,
                                 channel.gain.after.high})
        if (std::isfinite(value)) reach = std::max(reach, value);
  return reach;
}

void GainTable::fill() {
  clear();
  if (channels_.empty()) return;
  QTreeWidgetItem* simulation =
      addGroup(tr("open-loop simulation, on held-out data"),
               tr("Every segment of the recordings is evaluated with a model that was fitted to the others"));
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    addChannel(simulation, channels_[i]);
    simulation->child(static_cast<int>(i))->setText(kName, titles_[i]);
  }
  if (!filter_.empty()) {
    QTreeWidgetItem* filter =
        addGroup(tr("Kalman filter with each model, against the joint encoders"), QString());
    for (const diagnosis::FilterGain& gain : filter_) addFilter(filter, gain);
  }
  expandAll();
}

QTreeWidgetItem* GainTable::addGroup(const QString& words, const QString& tip) {
  auto* group = new QTreeWidgetItem({words});
  group->setFlags(Qt::ItemIsEnabled);
  group->setForeground(kName, theme_.muted);
  group->setFont(kName, textFont(kPoints - 0.5));
  group->setToolTip(kName, tip);
  addTopLevelItem(group);
  group->setFirstColumnSpanned(true);
  return group;
}

void GainTable::addRow(QTreeWidgetItem* group, const QStringList& cells) {
  auto* item = new QTreeWidgetItem(cells);
  for (int column = 0; column < kColumns; ++column) {
    item->setFont(column, column == kName ? textFont(kPoints) : numberFont(kPoints));
    if (column != kName && column != kDrawn)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  group->addChild(item);
}

void GainTable::addChannel(QTreeWidgetItem* group, const diagnosis::ChannelReport& channel) {
  const diagnosis::Gain& gain = channel.gain;
  const diagnosis::ShownUnit unit = diagnosis::shownUnit(gain.unit);
  const QString name = QString::fromStdString(unit.unit);
  const auto shown = [&](double value) {
    return significantText(unit.scale * value) + QLatin1Char(' ') + name;
  };
  addRow(group, {QString(), shown(channel.nominal_statistics.rms), shown(gain.rms_before),
                 shown(gain.rms_after), percentText(gain.rms_after / gain.rms_before, 1)});
  QTreeWidgetItem* item = group->child(group->childCount() - 1);
  item->setToolTip(kBefore, intervalTip(gain.before, unit.scale));
  item->setToolTip(kAfter, intervalTip(gain.after, unit.scale));
  item->setToolTip(kLeft, intervalTip(gain.interval, 100.0));
  const double reach = reachOf(gain.unit);
  QVariantList ends;
  for (const double value :
       {gain.rms_before, gain.before.low, gain.before.high, gain.rms_after, gain.after.low, gain.after.high})
    ends << (reach > 0.0 && std::isfinite(value) ? value / reach : 0.0);
  item->setData(kDrawn, kEndsRole, ends);
  item->setData(kDrawn, kColoursRole,
                QVariantList{theme_.colour(Quantity::kKinematic), theme_.colour(Quantity::kUkf)});
}

void GainTable::addFilter(QTreeWidgetItem* group, const diagnosis::FilterGain& gain) {
  const diagnosis::ShownUnit unit = diagnosis::shownUnit(gain.unit);
  const QString name = QString::fromStdString(unit.unit);
  QStringList cells{QString::fromStdString(gain.joint)};
  for (const double value : {gain.nominal, gain.refitted, gain.extended})
    cells << significantText(unit.scale * value) + QLatin1Char(' ') + name;
  cells << percentText(gain.extended / gain.refitted, 1);
  addRow(group, cells);
}

}  // namespace capstan::widgets
