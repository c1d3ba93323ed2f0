#include "widgets/figures/learning_curve_figure.h"

#include <algorithm>
#include <limits>

#include "core/base/units.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"
#include "widgets/figures/pose_source.h"

namespace capstan::widgets {

namespace {

using learning::CorrectionErrors;

constexpr int kLeastLearningCurveWidth = 330;  ///< [px] of panels side by side

double meanOf(const CorrectionErrors& errors, bool angle) {
  return base::degreesOrMillimetres(angle ? errors.angle : errors.distance, angle);
}
double medianOf(const CorrectionErrors& errors, bool angle) {
  return base::degreesOrMillimetres(angle ? errors.median_angle : errors.median_distance, angle);
}

QPen correctedPen(const Theme& theme, double line, bool median) {
  QPen pen(theme.colour(quantityOf(PoseSource::kCorrected)), (median ? 1.3 : 2.2) * line);
  if (median) pen.setDashPattern({4.0, 2.5});
  return pen;
}

QPen offsetPen(const Theme& theme, double line) {
  QPen pen(theme.colour(quantityOf(PoseSource::kOffset)), 1.4 * line);
  pen.setDashPattern({5.0, 3.0});
  return pen;
}

/// Ticks at the numbers of training states: always the last, and those of the others that have room.
QSharedPointer<QCPAxisTicker> statesTicker(const learning::LearningCurve& curve, const QCPAxis& axis) {
  const QFontMetricsF metrics(axis.tickLabelFont());
  const auto ticker = QSharedPointer<QCPAxisTickerText>::create();
  double right = std::numeric_limits<double>::infinity();
  for (auto point = curve.points.rbegin(); point != curve.points.rend(); ++point) {
    const QString words =
        QStringLiteral("%1\n%2 %").arg(point->states).arg(significantText(100.0 * point->share, 2));
    const auto states = static_cast<double>(point->states);
    const double wide = metrics.size(0, words).width(), at = axis.coordToPixel(states);
    if (at + 0.5 * wide + 0.5 * metrics.height() > right) continue;
    right = at - 0.5 * wide;
    ticker->addTick(states, words);
  }
  return ticker;
}

}  // namespace

LearningCurveFigure::LearningCurveFigure(LearningCurveData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  build(false);
  build(true);
  fit();
}

std::unique_ptr<Figure> LearningCurveFigure::copy() const {
  return std::make_unique<LearningCurveFigure>(data_);
}

void LearningCurveFigure::build(bool angle) {
  const auto& points = data_.curve.points;
  const Panel& panel = addPanel({{angle ? tr("angle [deg]") : tr("distance [mm]"), true}},
                                tr("training states [–], share of all training states [%]"),
                                angle ? tr("error [deg]") : tr("error [mm]"));
  panel.empty->setVisible(points.empty());
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  x->setScaleType(QCPAxis::stLogarithmic);
  Curves curves{addGraph(x, y), addGraph(x, y), addGraph(x, y)};
  double most = meanOf(data_.curve.offset, angle), from = 1.0, to = 10.0;
  QVector<double> keys, means, medians;
  for (const auto& point : points) {
    keys << static_cast<double>(point.states);
    means << meanOf(point.errors, angle);
    medians << medianOf(point.errors, angle);
    most = std::max(most, means.back());
  }
  if (!keys.isEmpty()) from = 0.8 * keys.front(), to = 1.25 * keys.back();
  curves.mean->setData(keys, means, true);
  curves.median->setData(keys, medians, true);
  curves.offset->setData({from, to}, QVector<double>(2, meanOf(data_.curve.offset, angle)), true);
  x->setRange(from, to);
  y->setRange(0.0, most > 0.0 ? 1.08 * most : 1.0);
  curves_.push_back(curves);
}

int LearningCurveFigure::columnsFor(QSize size) const {
  return size.width() >= 2 * kLeastLearningCurveWidth ? 2 : 1;
}

void LearningCurveFigure::laidOut() {
  for (const Panel& panel : panels()) {
    QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
    x->setTicker(statesTicker(data_.curve, *x));
  }
}

void LearningCurveFigure::restyle() {
  const double line = scale().line;
  const QColor ink = theme().colour(quantityOf(PoseSource::kCorrected));
  for (const Curves& curves : curves_) {
    curves.mean->setPen(correctedPen(theme(), line, false));
    curves.mean->setScatterStyle({QCPScatterStyle::ssDisc, ink, 6.0 * line});
    curves.median->setPen(correctedPen(theme(), line, true));
    curves.median->setScatterStyle({QCPScatterStyle::ssCircle, ink, theme().surface, 5.0 * line});
    curves.offset->setPen(offsetPen(theme(), line));
  }
  setLegend({lineEntry(tr("corrected, mean"), correctedPen(theme(), line, false)),
             lineEntry(tr("corrected, median"), correctedPen(theme(), line, true)),
             lineEntry(tr("rigid offset alone, mean"), offsetPen(theme(), line))});
}

std::vector<FigureNumbers> LearningCurveFigure::numbers() const {
  std::string rows =
      "share,states,distance mean [mm],distance median [mm],angle mean [deg],angle median [deg]";
  for (std::size_t k = 0; k < 6; ++k)
    rows += std::string(",") + learning::kDegreesOfFreedom[k] + (k < 3 ? " mean [mm]" : " mean [deg]");
  rows += '\n';
  for (const auto& point : data_.curve.points) {
    rows += csvNumber(point.share) + "," + std::to_string(point.states);
    for (const bool angle : {false, true})
      rows += "," + csvNumber(meanOf(point.errors, angle)) + "," + csvNumber(medianOf(point.errors, angle));
    for (Eigen::Index k = 0; k < 6; ++k)
      rows += "," + csvNumber(base::degreesOrMillimetres(point.errors.mean[k], k >= 3));
    rows += '\n';
  }
  return {{"", rows}};
}

}  // namespace capstan::widgets
