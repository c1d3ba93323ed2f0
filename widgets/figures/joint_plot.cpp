#include "widgets/figures/joint_plot.h"

#include <cmath>

namespace capstan::widgets {

namespace {

constexpr std::size_t kMostDots = 700;  ///< camera dots drawn at once; above it every n-th

/// What one full bucket or row contributes to a line: one point, or its lowest and highest.
void addPoints(QVector<QCPGraphData>& line, double t, float low, float high) {
  line.append({t, static_cast<double>(low)});
  if (high != low && !std::isnan(high)) line.append({t, static_cast<double>(high)});
}

QString number(double value, int decimals) {
  return std::isnan(value) ? QStringLiteral("—") : QString::number(value, 'f', decimals);
}

}  // namespace

JointPlot::JointPlot(QCustomPlot* plot, const JointHistory& history, int joint)
    : history_(history), joint_(joint) {
  header_ = new FigureHeader(plot, FigureHeader::Role::kValues);
  axes_ = new QCPAxisRect(plot, true);
  shade_ = new OcclusionShade(axes_, history, joint == 0);
  QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  QCPAxis* value = axes_->axis(QCPAxis::atLeft);
  for (QCPAxis* axis : {time, value}) {
    axis->setLayer("axes");
    axis->grid()->setLayer("grid");
    axis->setTickLengthIn(0);
    axis->setTickLengthOut(4);
    axis->setSubTickLength(0);
    axis->grid()->setZeroLinePen(Qt::NoPen);
  }
  value->ticker()->setTickCount(4);
  time->ticker()->setTickCount(7);
  value->setNumberFormat("f");
  time->setNumberFormat("f");
  time->setNumberPrecision(0);

  const auto add = [&] {
    auto* graph = plot->addGraph(time, value);
    graph->setAdaptiveSampling(false);  // the history has thinned already
    graph->setSelectable(QCP::stNone);
    return graph;
  };
  band_low_ = add();
  band_high_ = add();
  band_low_->setPen(Qt::NoPen);
  band_high_->setPen(Qt::NoPen);
  band_high_->setChannelFillGraph(band_low_);
  for (const Quantity quantity : {Quantity::kKinematic, Quantity::kUkf, Quantity::kTrue, Quantity::kCamera})
    graphs_[static_cast<std::size_t>(quantity)] = add();
  graph(Quantity::kCamera)->setLineStyle(QCPGraph::lsNone);
}

void JointPlot::setTitle(const QString& title, const QString& unit) {
  header_->setTitle(title);
  axes_->axis(QCPAxis::atLeft)->setLabel(QStringLiteral("q%1 [%2]").arg(joint_ + 1).arg(unit));
}

void JointPlot::setTheme(const Theme& theme) {
  header_->setTheme(theme);
  shade_->setTheme(theme);
  axes_->setBackground(QBrush(theme.surface));
  for (QCPAxis* axis : axes_->axes()) {
    axis->setBasePen(QPen(theme.border, 1));
    axis->setTickPen(QPen(theme.border, 1));
    axis->setTickLabelColor(theme.muted);
    axis->setLabelColor(theme.muted);
    axis->grid()->setPen(QPen(theme.grid, 1));
  }
  for (const Quantity quantity : {Quantity::kTrue, Quantity::kKinematic, Quantity::kUkf})
    graph(quantity)->setPen(theme.pen(quantity));
  const QColor dots = theme.colour(Quantity::kCamera);
  graph(Quantity::kCamera)->setPen(QPen(dots, 0));
  graph(Quantity::kCamera)->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, dots, dots, 5));
  QColor band = theme.colour(Quantity::kUkf);
  band.setAlpha(70);
  band_high_->setBrush(band);
}

void JointPlot::setPoints(double text_points, double number_points, double tick_points) {
  header_->setPoints(text_points, number_points);
  for (QCPAxis* axis : {axes_->axis(QCPAxis::atBottom), axes_->axis(QCPAxis::atLeft)}) {
    axis->setTickLabelFont(textFont(tick_points));
    axis->setLabelFont(textFont(tick_points));
  }
}

void JointPlot::include(double value) {
  if (!std::isfinite(value)) return;
  drawn_ =
      any_ ? QCPRange(std::min(drawn_.lower, value), std::max(drawn_.upper, value)) : QCPRange(value, value);
  any_ = true;
}

void JointPlot::fill(double begin, double end, std::size_t most) {
  for (auto* line : {&truth_, &kinematic_, &ukf_, &low_, &high_, &camera_}) line->resize(0);
  any_ = false;
  const auto joint = static_cast<std::size_t>(joint_);
  history_.forEach(begin, end, most, [&](double t, const auto& lows, const auto& highs) {
    const JointValues &low = lows[joint], &high = highs[joint];
    addPoints(truth_, t, low.truth, high.truth);
    addPoints(kinematic_, t, low.kinematic, high.kinematic);
    addPoints(ukf_, t, low.ukf, high.ukf);
    low_.append({t, static_cast<double>(low.ukf) - 2.0 * static_cast<double>(high.ukf_sigma)});
    high_.append({t, static_cast<double>(high.ukf) + 2.0 * static_cast<double>(high.ukf_sigma)});
    for (const float value : {low.truth, high.truth, low.kinematic, high.kinematic, low.ukf, high.ukf})
      include(static_cast<double>(value));
  });
  const auto& camera = history_.camera();
  const std::size_t first = camera.partitionPoint([&](const auto& point) { return point.t < begin; });
  const std::size_t last = camera.partitionPoint([&](const auto& point) { return point.t <= end; });
  const std::size_t stride = (last - first) / kMostDots + 1;
  const std::uint64_t oldest =
      camera.pushed() - camera.size();  // a dot keeps its place while the plot scrolls
  for (std::size_t i = first; i < last; ++i)
    if ((oldest + i) % stride == 0)
      camera_.append({camera[i].t, static_cast<double>(camera[i].value[joint])});
  graph(Quantity::kTrue)->data()->set(truth_, true);
  graph(Quantity::kKinematic)->data()->set(kinematic_, true);
  graph(Quantity::kUkf)->data()->set(ukf_, true);
  graph(Quantity::kCamera)->data()->set(camera_, true);
  band_low_->data()->set(low_, true);
  band_high_->data()->set(high_, true);
}

void JointPlot::showValuesAt(double t, double camera_reach) {
  const auto row = history_.at(t);
  const auto camera = history_.cameraAt(t, camera_reach);
  const auto joint = static_cast<std::size_t>(joint_);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const JointValues values = row ? row->joint[joint] : JointValues{NAN, NAN, NAN, NAN};
  header_->setValue(Quantity::kTrue, number(static_cast<double>(values.truth), 2));
  header_->setValue(Quantity::kKinematic, number(static_cast<double>(values.kinematic), 2));
  header_->setValue(Quantity::kCamera, number(camera ? static_cast<double>(camera->value[joint]) : none, 2));
  header_->setValue(Quantity::kUkf,
                    QStringLiteral("%1 ±%2").arg(number(static_cast<double>(values.ukf), 2),
                                                 number(2.0 * static_cast<double>(values.ukf_sigma), 2)));
}

void JointPlot::fitValues() {
  if (!fitting_ || !any_) return;
  const double span = std::max(drawn_.size(), 1.0);
  const QCPRange wanted(drawn_.center() - 0.58 * span, drawn_.center() + 0.58 * span);
  QCPAxis* axis = axes_->axis(QCPAxis::atLeft);
  const QCPRange now = axis->range();
  const bool outside = drawn_.lower < now.lower || drawn_.upper > now.upper;
  if (outside || wanted.size() < 0.6 * now.size()) axis->setRange(wanted);
  axis->setNumberPrecision(span < 4.0 ? 1 : 0);
}

}  // namespace capstan::widgets
