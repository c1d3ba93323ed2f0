#include "widgets/panels/diagnosis/gain_table.h"

#include <QHeaderView>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/report/shown.h"
#include "widgets/figures/figure_text.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/interval_cell.h"
#include "widgets/panels/diagnosis/table_font.h"

namespace capstan::widgets {

namespace {

/// "q2 (elbow) [deg]": the unit beside the name leaves the columns to the numbers.
QString withUnit(const QString& name, const std::string& si) {
  return QStringLiteral("%1 [%2]").arg(name, QString::fromStdString(diagnosis::shownUnit(si).unit));
}

QString intervalTip(const stats::Interval& interval, double scale) {
  return QObject::tr("95 %: %1 … %2")
      .arg(significantText(scale * interval.low), significantText(scale * interval.high));
}

}  // namespace

GainTable::GainTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("gain");
  setColumnCount(kColumns);
  setHeaderLabels({tr("RMS error of"), tr("robot file"), tr("refitted"), tr("extended"),
                   tr("extended /\nrefitted"), tr("■ refitted\n● extended")});
  headerItem()->setToolTip(kDrawn, tr("RMS with 95 % intervals; one axis for angles, one for lengths"));
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
  filter_ = report.filter;
  // Channels of one unit share an axis, which is drawn below the last of them.
  std::vector<const diagnosis::ChannelReport*> ordered;
  for (const diagnosis::ChannelReport& channel : report.channels) ordered.push_back(&channel);
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const auto* channel) { return channel->gain.unit == "rad"; });
  for (const diagnosis::ChannelReport* channel : ordered) {
    titles_.push_back(channelTitle(report, *channel));
    auto& kept = channels_.emplace_back();
    kept.nominal_statistics = channel->nominal_statistics;
    kept.refitted_statistics = channel->refitted_statistics;
    kept.extended_statistics = channel->extended_statistics;
    kept.gain = channel->gain;
  }
  fill();
}

double GainTable::reachOf(const std::string& unit) const {
  double reach = 0.0;
  for (const diagnosis::ChannelReport& channel : channels_)
    if (channel.gain.unit == unit)
      for (const double value : {channel.gain.rms_before, channel.gain.rms_after, channel.gain.before.high,
                                 channel.gain.after.high})
        if (std::isfinite(value)) reach = std::max(reach, value);
  return diagnosis::shownUnit(unit).scale * reach;
}

void GainTable::fill() {
  clear();
  if (channels_.empty()) return;
  QTreeWidgetItem* simulation =
      addGroup(tr("open-loop simulation, on held-out data"),
               tr("Every segment of the recordings is evaluated with a model that was fitted to the others"));
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    addChannel(simulation, channels_[i], titles_[i]);
    const std::string& unit = channels_[i].gain.unit;
    if (i + 1 == channels_.size() || channels_[i + 1].gain.unit != unit) addAxis(simulation, unit);
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
  group->setFont(kName, textFont(kTableFont - 0.5));
  group->setToolTip(kName, tip);
  addTopLevelItem(group);
  group->setFirstColumnSpanned(true);
  return group;
}

QTreeWidgetItem* GainTable::addRow(QTreeWidgetItem* group, const QStringList& cells) {
  auto* item = new QTreeWidgetItem(cells);
  for (int column = 0; column < kColumns; ++column) {
    item->setFont(column, column == kName ? textFont(kTableFont) : numberFont(kTableFont));
    if (column != kName && column != kDrawn)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  group->addChild(item);
  return item;
}

void GainTable::addChannel(QTreeWidgetItem* group, const diagnosis::ChannelReport& channel,
                           const QString& title) {
  const diagnosis::Gain& gain = channel.gain;
  const diagnosis::ShownUnit unit = diagnosis::shownUnit(gain.unit);
  const auto shown = [&](double value) { return significantText(unit.scale * value); };
  QTreeWidgetItem* item = addRow(
      group, {withUnit(title, gain.unit), shown(channel.nominal_statistics.rms), shown(gain.rms_before),
              shown(gain.rms_after), percentText(gain.rms_after / gain.rms_before, 1)});
  item->setToolTip(kBefore, intervalTip(gain.before, unit.scale));
  item->setToolTip(kAfter, intervalTip(gain.after, unit.scale));
  item->setToolTip(kLeft, intervalTip(gain.interval, 100.0));
  IntervalCell::set(*item, kDrawn, gain, unit.scale, IntervalAxis::to(reachOf(gain.unit)), theme_);
}

/// Row with the numbers of the axis that the channels of one unit share.
void GainTable::addAxis(QTreeWidgetItem* group, const std::string& unit) {
  QTreeWidgetItem* item = addRow(group, {QString()});
  item->setText(kLeft, QStringLiteral("[%1]").arg(QString::fromStdString(diagnosis::shownUnit(unit).unit)));
  item->setForeground(kLeft, theme_.muted);
  item->setFlags(Qt::ItemIsEnabled);
  IntervalCell::setAxis(*item, kDrawn, IntervalAxis::to(reachOf(unit)), theme_);
}

void GainTable::addFilter(QTreeWidgetItem* group, const diagnosis::FilterGain& gain) {
  const diagnosis::ShownUnit unit = diagnosis::shownUnit(gain.unit);
  QStringList cells{withUnit(QString::fromStdString(gain.joint), gain.unit)};
  for (const double value : {gain.nominal, gain.refitted, gain.extended})
    cells << significantText(unit.scale * value);
  cells << percentText(gain.extended / gain.refitted, 1);
  addRow(group, cells);
}

}  // namespace capstan::widgets
