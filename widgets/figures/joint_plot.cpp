#include "widgets/figures/joint_plot.h"

#include <cmath>
#include <limits>

#include "widgets/figures/number_text.h"
#include "widgets/figures/round_ticker.h"

namespace capstan::widgets {

namespace {

constexpr double kDash = 8.0, kDashPeriod = 15.0;  ///< dash and period of the kinematic line, along time [px]
constexpr double kProminence = 4.0;                ///< least height of a spike that no gap may hide [px]
constexpr double kDense = 0.5;                     ///< time per pixel from which a curve is a band [s]
constexpr double kTravel = 20.0;  ///< height that a line travels per width, from which it is an area
constexpr double kCasing = 0.8;   ///< width of the edge at each side of a dash [px]
constexpr double kDotSize = 5.0;  ///< [px]

QPixmap dotImage(const QColor& colour) {
  QPixmap image(static_cast<int>(kDotSize) + 1, static_cast<int>(kDotSize) + 1);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawEllipse(QRectF(0.5, 0.5, kDotSize, kDotSize));
  return image;
}

}  // namespace

JointPlot::JointPlot(QCustomPlot* plot, const JointHistory& history, int joint)
    : history_(&history), joint_(joint) {
  header_ = new FigureHeader(plot, FigureHeader::Role::kValues);
  axes_ = new QCPAxisRect(plot, true);
  axes_->setLayer("background");
  shade_ = new OcclusionShade(axes_, history, joint);
  detail_mark_ = new DetailMark(axes_, history, joint == 0);
  QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  QCPAxis* value = axes_->axis(QCPAxis::atLeft);
  for (QCPAxis* axis : {time, value}) {
    axis->setLayer("axes");
    axis->grid()->setLayer("grid");
    axis->grid()->setVisible(true);
    axis->setTicker(QSharedPointer<RoundTicker>::create());
    axis->setTickLengthIn(0);
    axis->setTickLengthOut(4);
    axis->setSubTickLength(0);
    axis->grid()->setZeroLinePen(Qt::NoPen);
  }

  const auto add = [&] {
    auto* graph = plot->addGraph(time, value);
    graph->setAdaptiveSampling(false);  // the history has thinned already
    graph->setSelectable(QCP::stNone);
    return graph;
  };
  band_ = new SigmaBand(axes_);
  // Thick lines are below thin ones, so that dashes and the thin line of the truth stay visible where they
  // coincide with the filter's.
  graphs_[static_cast<std::size_t>(Quantity::kCamera)] = add();
  graphs_[static_cast<std::size_t>(Quantity::kUkf)] = add();
  casing_ = add();
  graphs_[static_cast<std::size_t>(Quantity::kKinematic)] = add();
  graphs_[static_cast<std::size_t>(Quantity::kTrue)] = add();
  second_graph_ = add();
  graph(Quantity::kCamera)->setLineStyle(QCPGraph::lsNone);
}

void JointPlot::setTitle(const QString& title, const QString& unit, const QString& fault) {
  const QString words = QStringLiteral("%1 q%2 [%3]").arg(title).arg(joint_ + 1).arg(unit);
  header_->setTitle(fault.isEmpty() ? words : words + QStringLiteral(" · ") + fault);
  header_->setFault(!fault.isEmpty());
}

void JointPlot::setTheme(const Theme& theme, bool vectors, double widths) {
  widths_ = widths;
  on_screen_ = !vectors;
  header_->setTheme(theme);
  shade_->setTheme(theme);
  detail_mark_->setTheme(theme);
  axes_->setBackground(QBrush(theme.surface));
  for (QCPAxis* axis : axes_->axes()) {
    axis->setBasePen(QPen(theme.border, 1));
    axis->setTickPen(QPen(theme.border, 1));
    axis->setTickLabelColor(theme.muted);
    axis->setLabelColor(theme.muted);
    axis->grid()->setPen(QPen(theme.grid, 1));
  }
  for (const Quantity quantity : {Quantity::kTrue, Quantity::kKinematic, Quantity::kUkf}) {
    QPen pen = theme.pen(quantity);
    pen.setStyle(Qt::SolidLine);  // the kinematic line's dashes are cut into its points
    pen.setCapStyle(Qt::FlatCap);
    pen.setWidthF(widths * pen.widthF());
    pens_[graph(quantity)] = pen;
  }
  QPen casing = pens_[graph(Quantity::kKinematic)];
  casing.setColor(theme.surface);
  casing.setWidthF(casing.widthF() + 2.0 * widths * kCasing);
  pens_[casing_] = casing;
  pens_[second_graph_] = QPen(theme.accent, 1.8 * widths, Qt::SolidLine, Qt::FlatCap);
  useThinPens(area_);
  const QColor dots = theme.colour(Quantity::kCamera);
  graph(Quantity::kCamera)->setPen(QPen(dots, 0));
  graph(Quantity::kCamera)
      ->setScatterStyle(vectors ? QCPScatterStyle(QCPScatterStyle::ssDisc, dots, dots, widths * kDotSize)
                                : QCPScatterStyle(dotImage(dots)));
  band_->setColour(theme.band());
}

/// Whether the curve rises and falls so often that its lines fill an area.
bool JointPlot::fillsArea() const {
  const QVector<QCPGraphData>& line = ukf_.points();
  double travel = 0.0;
  for (int i = 1; i < line.size(); ++i) {
    const double step = std::abs(line[i].value - line[i - 1].value);
    if (std::isfinite(step)) travel += step;
  }
  return travel * axes_->height() > kTravel * drawn_.size() * axes_->width();
}

/// Thick pens show nothing where lines fill an area, and each segment is stroked as an area of its own. A
/// cosmetic pen of one pixel is drawn directly.
void JointPlot::useThinPens(bool on) {
  area_ = on;
  for (auto [graph, pen] : pens_) {
    if (on) pen.setWidth(1), pen.setCosmetic(true);
    graph->setPen(pen);
  }
}

void JointPlot::setTickPoints(double points) {
  for (QCPAxis* axis : {axes_->axis(QCPAxis::atBottom), axes_->axis(QCPAxis::atLeft)}) {
    axis->setTickLabelFont(textFont(points));
    axis->setLabelFont(textFont(points));
  }
}

void JointPlot::setHistory(const JointHistory& history, double least_range) {
  history_ = &history;
  least_range_ = least_range;
  shade_->setHistory(history);
  detail_mark_->setHistory(history);
}

void JointPlot::setSecond(const JointHistory* history) {
  second_ = history;
  if (!history) second_graph_->data()->clear();
}

void JointPlot::setShown(Quantity quantity, bool on) {
  graph(quantity)->setVisible(on);
  if (quantity == Quantity::kKinematic) casing_->setVisible(on);
  if (quantity == Quantity::kUkf) band_->setVisible(on);
}

void JointPlot::include(Quantity quantity, float number) {
  const auto value = static_cast<double>(number);
  if (!shown(quantity) || !std::isfinite(value)) return;
  drawn_ =
      any_ ? QCPRange(std::min(drawn_.lower, value), std::max(drawn_.upper, value)) : QCPRange(value, value);
  any_ = true;
}

void JointPlot::chooseTicks() {
  const double label = QFontMetricsF(axes_->axis(QCPAxis::atLeft)->tickLabelFont()).height();
  axes_->axis(QCPAxis::atBottom)
      ->ticker()
      ->setTickCount(std::max(2, static_cast<int>(axes_->width() / (4.5 * label))));
  axes_->axis(QCPAxis::atLeft)
      ->ticker()
      ->setTickCount(std::clamp(static_cast<int>(axes_->height() / (2.0 * label)), 2, 7));
}

void JointPlot::fill(double begin, double end, std::size_t most) {
  chooseTicks();
  for (auto* line : {&truth_, &kinematic_, &ukf_}) line->begin();
  band_->begin();
  any_ = false;
  const auto joint = static_cast<std::size_t>(joint_);
  history_->forEach(begin, end, most, [&](double t, double step, const auto& lows, const auto& highs) {
    const JointValues &low = lows[joint], &high = highs[joint];
    truth_.add(t, step, low.truth, high.truth);
    kinematic_.add(t, step, low.kinematic, high.kinematic);
    ukf_.add(t, step, low.ukf, high.ukf);
    band_->add(t + 0.5 * step, static_cast<double>(low.ukf) - 2.0 * static_cast<double>(high.ukf_sigma),
               static_cast<double>(high.ukf) + 2.0 * static_cast<double>(high.ukf_sigma));
    for (const JointValues* values : {&low, &high}) {
      include(Quantity::kTrue, values->truth);
      include(Quantity::kKinematic, values->kinematic);
      include(Quantity::kUkf, values->ukf);
    }
  });
  fillSecond(begin, end, most);
  const double pixel = widths_ * (end - begin) / std::max(axes_->width(), 1);
  // At such a scale smooth edges show nothing and cost most of the drawing.
  const bool coarse = on_screen_ && (end - begin) / std::max(axes_->width(), 1) > kDense;
  for (const auto& [graph, pen] : pens_) graph->setAntialiased(!coarse);
  if (const bool area = coarse && fillsArea(); area != area_) useThinPens(area);
  const double prominence = widths_ * kProminence * drawn_.size() / std::max(axes_->height(), 1);
  DashCutter(kDashPeriod * pixel, kDash * pixel, prominence).cut(kinematic_.points(), dashed_);
  graph(Quantity::kTrue)->data()->set(truth_.points(), true);
  graph(Quantity::kKinematic)->data()->set(dashed_, true);
  casing_->setData(graph(Quantity::kKinematic)->data());
  graph(Quantity::kUkf)->data()->set(ukf_.points(), true);
  fillCamera(begin, end);
}

void JointPlot::fillSecond(double begin, double end, std::size_t most) {
  if (!second_) return;
  second_line_.begin();
  const auto joint = static_cast<std::size_t>(joint_);
  second_->forEach(begin, end, most, [&](double t, double step, const auto& lows, const auto& highs) {
    second_line_.add(t, step, lows[joint].ukf, highs[joint].ukf);
    include(Quantity::kUkf, lows[joint].ukf);
    include(Quantity::kUkf, highs[joint].ukf);
  });
  const double pixel = widths_ * (end - begin) / std::max(axes_->width(), 1);
  const double prominence = widths_ * kProminence * drawn_.size() / std::max(axes_->height(), 1);
  DashCutter(kDashPeriod * pixel, kDash * pixel, prominence).cut(second_line_.points(), dashed_);
  second_graph_->data()->set(dashed_, true);
}

/// For more dots than can be drawn: the lowest and the highest of each block, at the times of its first and
/// its last dot, in the order that follows the curve.
void JointPlot::fillCamera(double begin, double end) {
  camera_.resize(0);
  const auto joint = static_cast<std::size_t>(joint_);
  const auto add = [&](double t, double value) {
    if (t < begin || t > end) return;
    camera_.append({t, value});
    include(Quantity::kCamera, static_cast<float>(value));
  };
  double last = -std::numeric_limits<double>::infinity();
  history_->forEachCamera(
      begin, end, most_dots_, [&](double t, double step, const auto& low, const auto& high) {
        const auto a = static_cast<double>(low[joint]), b = static_cast<double>(high[joint]);
        const bool rising = a + b >= last;
        add(t, rising ? a : b);
        if (a != b) add(t + step, rising ? b : a);
        last = a + b;
      });
  graph(Quantity::kCamera)->data()->set(camera_, true);
}

JointPlot::Readout JointPlot::readoutAt(double t, double camera_reach) const {
  const auto row = history_->at(t);
  const auto camera = history_->cameraAt(t, camera_reach);
  const auto joint = static_cast<std::size_t>(joint_);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!row) return {kNone, kNone, camera ? static_cast<double>(camera->value[joint]) : kNone, kNone, kNone};
  const JointValues& values = row->joint[joint];
  return {static_cast<double>(values.truth), static_cast<double>(values.kinematic),
          camera ? static_cast<double>(camera->value[joint]) : kNone, static_cast<double>(values.ukf),
          2.0 * static_cast<double>(values.ukf_sigma)};
}

void JointPlot::showValuesAt(double t, double camera_reach) {
  const Readout values = readoutAt(t, camera_reach);
  for (std::size_t i = 0; i < graphs_.size(); ++i)
    header_->setValue(static_cast<Quantity>(i), valueText(values[i]));
  header_->setSigma(sigmaText(values.back()));
}

void JointPlot::showDifferences(double from, double to, double camera_reach) {
  const Readout before = readoutAt(from, camera_reach), after = readoutAt(to, camera_reach);
  for (std::size_t i = 0; i < graphs_.size(); ++i)
    header_->setValue(static_cast<Quantity>(i), valueText(after[i] - before[i]));
  header_->setSigma(QString());
}

void JointPlot::fitValues() {
  if (!fitting_ || !any_) return;
  const double span = std::max(drawn_.size(), least_range_);
  const QCPRange wanted(drawn_.center() - 0.58 * span, drawn_.center() + 0.58 * span);
  QCPAxis* axis = axes_->axis(QCPAxis::atLeft);
  const QCPRange now = axis->range();
  const bool outside = drawn_.lower < now.lower || drawn_.upper > now.upper;
  if (outside || wanted.size() < 0.6 * now.size()) axis->setRange(wanted);
}

}  // namespace capstan::widgets
