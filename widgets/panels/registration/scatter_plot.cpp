#include "widgets/panels/registration/scatter_plot.h"

#include <qcustomplot.h>

#include <QHBoxLayout>

#include "core/base/units.h"
#include "widgets/figures/round_ticker.h"
#include "widgets/figures/tick_fit.h"

namespace capstan::widgets {

namespace {

constexpr double kMillimetres = base::toMillimetres(1.0);
constexpr int kMostTicks = 7;  ///< of a horizontal axis

QCPGraph* marks(QCustomPlot& plot, QCPScatterStyle::ScatterShape shape, double size) {
  auto* graph = plot.addGraph();
  graph->setLineStyle(QCPGraph::lsNone);
  graph->setScatterStyle(QCPScatterStyle(shape, size));
  return graph;
}

void colour(QCPGraph& graph, const QColor& ink) {
  graph.setPen(QPen(ink, 1.6));
  auto style = graph.scatterStyle();
  style.setPen(graph.pen());
  if (style.shape() == QCPScatterStyle::ssDisc) style.setBrush(ink);
  graph.setScatterStyle(style);
}

void dress(QCustomPlot& plot, const Theme& theme) {
  plot.setBackground(theme.surface);
  for (auto* axis : {plot.xAxis, plot.yAxis, plot.xAxis2, plot.yAxis2}) {
    axis->setBasePen(theme.border);
    axis->setTickPen(theme.border);
    axis->setSubTickPen(Qt::NoPen);
    axis->setTickLabelColor(theme.muted);
    axis->setLabelColor(theme.text);
    axis->setTickLabelFont(numberFont(8.5));
    axis->setLabelFont(textFont(9.5));
    axis->grid()->setPen(QPen(theme.grid, 1.0));
    axis->grid()->setZeroLinePen(QPen(theme.border, 1.0));
  }
}

}  // namespace

ScatterPlot::ScatterPlot(QWidget* parent)
    : QWidget(parent), across_(new QCustomPlot), depth_(new QCustomPlot) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(1);
  row->addWidget(across_, 5);
  row->addWidget(depth_, 6);
  across_->xAxis->setLabel("camera x − median [mm]");
  across_->yAxis->setLabel("camera y − median [mm]");
  across_->yAxis->setRangeReversed(true);
  depth_->xAxis->setLabel("frame");
  depth_->yAxis->setLabel("camera z − median [mm]");
  for (auto* plot : {across_, depth_}) {
    plot->axisRect()->setupFullAxesBox(false);
    for (auto* axis : {plot->xAxis, plot->yAxis}) axis->setTicker(QSharedPointer<RoundTicker>::create());
  }
  ellipse_ = new QCPItemEllipse(across_);
  depth_low_ = new QCPItemLine(depth_);
  depth_high_ = new QCPItemLine(depth_);
  used_ = marks(*across_, QCPScatterStyle::ssDisc, 5.0);
  rejected_ = marks(*across_, QCPScatterStyle::ssCross, 9.0);
  depth_used_ = marks(*depth_, QCPScatterStyle::ssDisc, 5.0);
  depth_rejected_ = marks(*depth_, QCPScatterStyle::ssCross, 9.0);
  setTheme(Theme::dark());
}

void ScatterPlot::setTheme(const Theme& theme) {
  for (auto* plot : {across_, depth_}) dress(*plot, theme);
  for (auto* graph : {used_, depth_used_}) colour(*graph, theme.colour(Quantity::kCamera));
  for (auto* graph : {rejected_, depth_rejected_}) colour(*graph, theme.fault);
  ellipse_->setPen(QPen(theme.text, 1.2, Qt::DashLine));
  for (auto* line : {depth_low_, depth_high_}) line->setPen(QPen(theme.text, 1.2, Qt::DashLine));
  for (auto* plot : {across_, depth_}) plot->replot(QCustomPlot::rpQueuedReplot);
}

void ScatterPlot::showGuide(const registration::RegistrationGuide& guide) {
  for (auto* graph : {used_, rejected_, depth_used_, depth_rejected_}) graph->data()->clear();
  const auto& scatter = guide.scatter();
  const Eigen::Vector3d sigma = kMillimetres * scatter.sigma,
                        mean = kMillimetres * (scatter.mean - scatter.median);
  double frame = 0.0, deep = 0.5;
  reach_ = 0.2;
  for (const auto& point : guide.points()) {
    const Eigen::Vector3d at = kMillimetres * (point.position - scatter.median);
    const bool used = point.verdict == registration::PointVerdict::kUsed;
    (used ? used_ : rejected_)->addData(at.x(), at.y());
    (used ? depth_used_ : depth_rejected_)->addData(++frame, at.z());
    reach_ = std::max({reach_, 1.15 * std::abs(at.x()), 1.15 * std::abs(at.y())});
    deep = std::max(deep, 1.15 * std::abs(at.z()));
  }
  ellipse_->setVisible(scatter.used > 2);
  ellipse_->topLeft->setCoords(mean.x() - 2 * sigma.x(), mean.y() - 2 * sigma.y());
  ellipse_->bottomRight->setCoords(mean.x() + 2 * sigma.x(), mean.y() + 2 * sigma.y());
  depth_frames_ =
      std::max(registration::RegistrationGuide::kFrames, static_cast<int>(guide.points().size())) + 1;
  for (const double side : {-1.0, 1.0}) {
    auto* line = side < 0 ? depth_low_ : depth_high_;
    line->setVisible(scatter.used > 2);
    line->start->setCoords(0, mean.z() + side * 2 * sigma.z());
    line->end->setCoords(depth_frames_, mean.z() + side * 2 * sigma.z());
  }
  depth_->xAxis->setRange(0, depth_frames_);
  depth_->yAxis->setRange(-deep, deep);
  scaleAcross();
}

void ScatterPlot::scaleAcross() {
  const QRect area = across_->axisRect()->rect();
  const double shorter = std::max(1, std::min(area.width(), area.height()));
  across_->xAxis->setRange(-reach_ * area.width() / shorter, reach_ * area.width() / shorter);
  across_->yAxis->setRange(-reach_ * area.height() / shorter, reach_ * area.height() / shorter);
  for (auto* plot : {across_, depth_}) {
    fitTickCount(*plot->xAxis, kMostTicks);
    plot->replot(QCustomPlot::rpQueuedReplot);
  }
}

void ScatterPlot::resizeEvent(QResizeEvent*) {
  across_->replot();
  scaleAcross();
}

int ScatterPlot::usedShown() const { return used_->dataCount(); }
int ScatterPlot::outliersShown() const { return rejected_->dataCount(); }

}  // namespace capstan::widgets
