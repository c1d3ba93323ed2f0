#include "widgets/figures/confidence_figure.h"

#include "core/base/units.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"

namespace capstan::widgets {

namespace {

QCPColorGradient gradientOf(const Theme& theme) {
  QCPColorGradient gradient;
  gradient.clearColorStops();
  gradient.setColorStopAt(0.0, theme.surface);
  gradient.setColorStopAt(1.0, theme.accent);
  gradient.setLevelCount(100);
  return gradient;
}

QString axisLabel(int axis) { return QStringLiteral("%1 [mm]").arg(QLatin1Char("xyz"[axis])); }

}  // namespace

ConfidenceFigure::ConfidenceFigure(ConfidenceData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  const learning::ConfidenceSlice& slice = data_.slice;
  const Panel& panel = addPanel({}, axisLabel(slice.right), axisLabel(slice.up));
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  panel.empty->setVisible(slice.confidence.size() == 0);
  const auto rows = static_cast<int>(slice.confidence.rows());
  const auto columns = static_cast<int>(slice.confidence.cols());
  map_ = new QCPColorMap(x, y);
  map_->data()->setSize(std::max(columns, 1), std::max(rows, 1));
  map_->data()->setRange({base::toMillimetres(slice.low[0]), base::toMillimetres(slice.high[0])},
                         {base::toMillimetres(slice.low[1]), base::toMillimetres(slice.high[1])});
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      map_->data()->setCell(column, row, slice.confidence(row, column));
  map_->setDataRange({0.0, 1.0});
  map_->setTightBoundary(true);
  learned_ = addGraph(x, y);
  learned_->setLineStyle(QCPGraph::lsNone);
  learned_->setAdaptiveSampling(false);
  QVector<double> keys, values;
  for (const Eigen::Vector2d& at : slice.learned)
    keys << base::toMillimetres(at[0]), values << base::toMillimetres(at[1]);
  learned_->setData(keys, values);
  fit();
}

std::unique_ptr<Figure> ConfidenceFigure::copy() const { return std::make_unique<ConfidenceFigure>(data_); }

void ConfidenceFigure::restyle() {
  const QCPColorGradient gradient = gradientOf(theme());
  QColor ink = theme().text;
  ink.setAlpha(150);
  const QCPScatterStyle mark(QCPScatterStyle::ssDisc, ink, 2.4 * scale().line);
  map_->setGradient(gradient);
  learned_->setScatterStyle(mark);
  std::vector<LegendEntry> entries;
  for (const double sure : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const QColor fill = QCPColorGradient(gradient).color(sure, {0.0, 1.0});
    entries.push_back({sure == 0.0 ? tr("confidence 0") : QString::number(sure),
                       [fill, edge = theme().muted](QCPPainter* painter, const QRectF& box) {
                         painter->setPen(QPen(edge, 0.8));
                         painter->setBrush(fill);
                         painter->drawRect(box);
                       }});
  }
  entries.push_back(markEntry(
      tr("training positions within %1 mm of the plane").arg(base::toMillimetres(data_.slice.near)), mark));
  setLegend(std::move(entries));
}

/// Sets the same scale on both axes: the longer side fills its axis, the other has room around it.
void ConfidenceFigure::laidOut() {
  const QCPAxisRect* axes = panels().front().axes;
  const QCPRange keys = map_->data()->keyRange(), values = map_->data()->valueRange();
  const double across = keys.size() / std::max(axes->width(), 1);
  const double up = values.size() / std::max(axes->height(), 1);
  const double pixel = std::max({across, up, 1e-9});
  const double wide = 0.5 * pixel * axes->width(), high = 0.5 * pixel * axes->height();
  axes->axis(QCPAxis::atBottom)->setRange(keys.center() - wide, keys.center() + wide);
  axes->axis(QCPAxis::atLeft)->setRange(values.center() - high, values.center() + high);
}

std::vector<FigureNumbers> ConfidenceFigure::numbers() const {
  const learning::ConfidenceSlice& slice = data_.slice;
  std::string rows = "x [mm],y [mm],z [mm],confidence\n";
  const auto place = [](double low, double high, Eigen::Index k, Eigen::Index count) {
    return count > 1 ? low + (high - low) * static_cast<double>(k) / static_cast<double>(count - 1) : low;
  };
  for (Eigen::Index row = 0; row < slice.confidence.rows(); ++row)
    for (Eigen::Index column = 0; column < slice.confidence.cols(); ++column) {
      Eigen::Vector3d at;
      at[slice.axis] = slice.at;
      at[slice.right] = place(slice.low[0], slice.high[0], column, slice.confidence.cols());
      at[slice.up] = place(slice.low[1], slice.high[1], row, slice.confidence.rows());
      for (const double value : at) rows += csvNumber(base::toMillimetres(value)) + ",";
      rows += csvNumber(slice.confidence(row, column)) + "\n";
    }
  return {{"", rows}};
}

}  // namespace capstan::widgets
