#include "widgets/figures/reliability_figure.h"

#include <algorithm>

#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"
#include "widgets/figures/pose_source.h"

namespace capstan::widgets {

namespace {

constexpr int kLeastReliabilityWidth = 330;  ///< [px] of panels side by side
constexpr int kSteps = 100;                  ///< number of stated shares

double stepShare(int step) { return std::min(static_cast<double>(step) / kSteps, 0.9999); }

QPen curvePen(const Theme& theme, double line, std::size_t which) {
  QPen pen(theme.colour(quantityOf(PoseSource::kCorrected)), 1.8 * line);
  if (which == 1) pen.setDashPattern({5.0, 2.5});
  if (which == 2) pen.setDashPattern({1.2, 2.0});
  return pen;
}

QPen diagonalPen(const Theme& theme, double line) { return QPen(theme.muted, 1.0 * line); }

}  // namespace

ReliabilityFigure::ReliabilityFigure(ReliabilityData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  build(false);
  build(true);
  fit();
}

std::unique_ptr<Figure> ReliabilityFigure::copy() const { return std::make_unique<ReliabilityFigure>(data_); }

void ReliabilityFigure::build(bool rotation) {
  const Panel& panel = addPanel({{rotation ? tr("rotation [%]") : tr("position [%]"), true}},
                                tr("stated probability [%]"), tr("errors within the interval [%]"));
  panel.empty->setVisible(data_.stated.states() == 0);
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  for (QCPAxis* axis : {x, y}) axis->setRange(0.0, 100.0);
  diagonals_.push_back(addGraph(x, y));
  diagonals_.back()->setData({0.0, 100.0}, {0.0, 100.0}, true);
  for (std::size_t k = 0; k < 3; ++k) {
    QVector<double> stated, found;
    for (int step = 0; step <= kSteps; ++step) {
      stated << 100.0 * stepShare(step);
      found << 100.0 * data_.stated.within(rotation ? 3 + k : k, learning::normalSigmas(stepShare(step)));
    }
    curves_.push_back(addGraph(x, y));
    if (data_.stated.states() > 0) curves_.back()->setData(stated, found, true);
  }
}

int ReliabilityFigure::columnsFor(QSize size) const {
  return size.width() >= 2 * kLeastReliabilityWidth ? 2 : 1;
}

void ReliabilityFigure::restyle() {
  const double line = scale().line;
  for (std::size_t k = 0; k < curves_.size(); ++k) curves_[k]->setPen(curvePen(theme(), line, k % 3));
  for (QCPGraph* diagonal : diagonals_) diagonal->setPen(diagonalPen(theme(), line));
  setLegend({lineEntry(tr("x, about x"), curvePen(theme(), line, 0)),
             lineEntry(tr("y, about y"), curvePen(theme(), line, 1)),
             lineEntry(tr("z, about z"), curvePen(theme(), line, 2)),
             lineEntry(tr("as stated"), diagonalPen(theme(), line))});
}

std::vector<FigureNumbers> ReliabilityFigure::numbers() const {
  std::string rows = "stated,sigmas,x,y,z,about x,about y,about z\n";
  for (int step = 1; step <= kSteps; ++step) {
    const double sigmas = learning::normalSigmas(stepShare(step));
    rows += csvNumber(stepShare(step)) + "," + csvNumber(sigmas);
    for (std::size_t k = 0; k < 6; ++k) rows += "," + csvNumber(data_.stated.within(k, sigmas));
    rows += '\n';
  }
  return {{"", rows}};
}

}  // namespace capstan::widgets
