#include "widgets/panels/identification/trace_plot.h"

#include <qcustomplot.h>

#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/identification/live_text.h"
#include "widgets/figures/axis_style.h"
#include "widgets/figures/round_ticker.h"

namespace capstan::widgets {

TracePlot::TracePlot(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(plot_);
  low_ = plot_->addGraph();
  high_ = plot_->addGraph();
  value_ = plot_->addGraph();
  high_->setChannelFillGraph(low_);
  nominal_ = new QCPItemStraightLine(plot_);
  for (auto* axis : {plot_->xAxis, plot_->yAxis}) {
    const QSharedPointer<RoundTicker> ticker(new RoundTicker);
    ticker->setTickCount(axis == plot_->xAxis ? 5 : 3);
    axis->setTicker(ticker);
    axis->setTickLengthIn(0);
    axis->setSubTicks(false);
    axis->setLabelPadding(1);
    axis->setTickLabelPadding(3);
  }
  plot_->axisRect()->setMinimumMargins(QMargins(0, 4, 4, 0));
  plot_->setAttribute(Qt::WA_TransparentForMouseEvents);
  setAccessibleName(tr("the chosen parameter over time"));
  setTheme(Theme::dark());
}

void TracePlot::setTheme(const Theme& theme) {
  plot_->setBackground(theme.surface);
  for (auto* axis : {plot_->xAxis, plot_->yAxis}) styleAxis(*axis, theme);
  for (auto* graph : {low_, high_}) graph->setPen(Qt::NoPen);
  high_->setBrush(theme.band());
  QPen ink = theme.pen(Quantity::kUkf);
  ink.setWidthF(2.2);
  value_->setPen(ink);
  nominal_->setPen(QPen(theme.muted, 1.2, Qt::DashLine));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void TracePlot::clear() {
  for (auto* graph : {low_, high_, value_}) graph->data()->clear();
  nominal_->setVisible(false);
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

int TracePlot::points() const { return value_->dataCount(); }

void TracePlot::showTrace(const identification::Trace& trace, const identification::ParameterSet& set,
                          int parameter) {
  if (trace.size() < 2) return clear();
  const auto& of = set[parameter];
  const double unit = identification::scaleOf(of) * of.nominal;
  QVector<double> t, low, value, high;
  for (const auto& point : trace) {
    const double log = point.log(parameter), two_sigma = 2.0 * point.sigma(parameter);
    t << point.t;
    value << unit * std::exp(log);
    low << unit * std::exp(log - two_sigma);
    high << unit * std::exp(log + two_sigma);
  }
  low_->setData(t, low, true);
  high_->setData(t, high, true);
  value_->setData(t, value, true);
  nominal_->setVisible(true);
  nominal_->point1->setCoords(0.0, unit);
  nominal_->point2->setCoords(1.0, unit);
  const double lowest = std::min({unit, low.back(), *std::min_element(value.begin(), value.end())});
  const double highest = std::max({unit, high.back(), *std::max_element(value.begin(), value.end())});
  const double margin = std::max(0.08 * (highest - lowest), 1e-6 * unit);
  plot_->yAxis->setRange(lowest - margin, highest + margin);
  plot_->xAxis->setRange(0.0, std::max(10.0, t.back()));
  plot_->xAxis->setLabel(
      tr("%1 [%2] over recorded time [s]")
          .arg(QString::fromStdString(of.name()), QString::fromStdString(identification::unitOf(of))));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

}  // namespace capstan::widgets
