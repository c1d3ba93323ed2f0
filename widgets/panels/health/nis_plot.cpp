#include "widgets/panels/health/nis_plot.h"

#include <qcustomplot.h>

#include <QVBoxLayout>
#include <algorithm>

#include "widgets/figures/axis_style.h"
#include "widgets/figures/round_ticker.h"

namespace capstan::widgets {

namespace {

constexpr double kLowest = 0.02, kHighest = 50.0;  // of the shown NIS

}  // namespace

NisPlot::NisPlot(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(plot_);
  plot_->plotLayout()->clear();
  plot_->plotLayout()->setRowSpacing(2);
  auto* margins = new QCPMarginGroup(plot_);
  for (int joint = 0; joint < 3; ++joint) {
    joints_[static_cast<std::size_t>(joint)] = addJoint(joint);
    joints_[static_cast<std::size_t>(joint)].axes->setMarginGroup(QCP::msLeft | QCP::msRight, margins);
  }
  plot_->setAttribute(Qt::WA_TransparentForMouseEvents);
  setAccessibleName(tr("NIS of every joint over time"));
  setTheme(Theme::dark());
  clear();
}

NisPlot::Joint NisPlot::addJoint(int joint) {
  Joint added{};
  added.axes = new QCPAxisRect(plot_);
  plot_->plotLayout()->addElement(joint, 0, added.axes);
  added.axes->setMinimumMargins(QMargins(0, 4, 8, 0));
  QCPAxis* time = added.axes->axis(QCPAxis::atBottom);
  QCPAxis* value = added.axes->axis(QCPAxis::atLeft);
  value->setScaleType(QCPAxis::stLogarithmic);
  const QSharedPointer<QCPAxisTickerText> ticks(new QCPAxisTickerText);
  for (const double tick : {0.1, 1.0, 10.0}) ticks->addTick(tick, QString::number(tick));
  value->setTicker(ticks);
  value->setRange(kLowest, kHighest);
  value->setLabel(QStringLiteral("NIS q%1").arg(joint + 1));
  const QSharedPointer<RoundTicker> ticker(new RoundTicker);
  ticker->setTickCount(6);
  time->setTicker(ticker);
  time->setTickLabels(joint == 2);
  if (joint == 2) time->setLabel(tr("time [s]"));
  for (auto* axis : {time, value}) {
    axis->setTickLengthIn(0);
    axis->setSubTicks(false);
    axis->setLabelPadding(2);
  }
  added.nis = plot_->addGraph(time, value);
  added.band = new QCPItemRect(plot_);
  added.one = new QCPItemStraightLine(plot_);
  const auto place = [&](QCPItemPosition* position, double x, double y) {
    position->setTypeX(QCPItemPosition::ptAxisRectRatio);
    position->setTypeY(QCPItemPosition::ptPlotCoords);
    position->setAxisRect(added.axes);
    position->setAxes(time, value);
    position->setCoords(x, y);
  };
  place(added.band->topLeft, 0.0, limits_.nis);
  place(added.band->bottomRight, 1.0, limits_.nis_low);
  place(added.one->point1, 0.0, 1.0);
  place(added.one->point2, 1.0, 1.0);
  for (QCPAbstractItem* item :
       {static_cast<QCPAbstractItem*>(added.band), static_cast<QCPAbstractItem*>(added.one)}) {
    item->setClipAxisRect(added.axes);
    item->setClipToAxisRect(true);
    item->setLayer("background");
  }
  return added;
}

void NisPlot::setTheme(const Theme& theme) {
  plot_->setBackground(theme.surface);
  for (const Joint& joint : joints_) {
    for (auto* axis : joint.axes->axes()) styleAxis(*axis, theme);
    joint.nis->setPen(QPen(theme.text, 1.4));
    joint.nis->setScatterStyle({QCPScatterStyle::ssDisc, theme.text, 3.0});
    QColor band = theme.accent;
    band.setAlpha(45);
    joint.band->setPen(Qt::NoPen);
    joint.band->setBrush(band);
    joint.one->setPen(QPen(theme.muted, 1.0, Qt::DashLine));
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

int NisPlot::points() const { return joints_[0].nis->dataCount(); }

void NisPlot::showRecord(const tracking::InnovationRecord& record) {
  std::array<QVector<double>, 3> values;
  QVector<double> times;
  for (const auto& window : record.windows()) {
    times << (static_cast<double>(window.index) + 0.5) * record.length();
    for (int joint = 0; joint < 3; ++joint)
      values[static_cast<std::size_t>(joint)] << std::clamp(window.nis()(joint), kLowest, kHighest);
  }
  const double begin = times.isEmpty() ? 0.0 : times.front() - 0.5 * record.length();
  const double end = times.isEmpty() ? 10.0 : std::max(times.back() + 0.5 * record.length(), begin + 10.0);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    joints_[joint].nis->setData(times, values[joint], true);
    joints_[joint].axes->axis(QCPAxis::atBottom)->setRange(begin, end);
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace capstan::widgets
