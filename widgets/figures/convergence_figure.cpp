#include "widgets/figures/convergence_figure.h"

#include <algorithm>
#include <cmath>

#include "core/base/nan.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"

namespace capstan::widgets {

namespace {

constexpr double kBandFrom = 0.2;            ///< share of the time after which the axis includes the band
constexpr int kLeastConvergenceWidth = 160;  ///< [px] of panels side by side
constexpr int kFewPanels = 3;                ///< up to so many panels share one column of a broad figure

bool known(const ConvergencePanel& data, std::size_t i) {
  return std::isfinite(data.t[i]) && std::isfinite(data.value[i]);
}

/// Index of the last known value; none: no known value.
std::optional<std::size_t> lastOf(const ConvergencePanel& data) {
  for (std::size_t i = data.t.size(); i-- > 0;)
    if (known(data, i)) return i;
  return std::nullopt;
}

QCPRange timeOf(const ConvergencePanel& data) {
  QCPRange range(base::kNaN, base::kNaN);
  for (const double t : data.t) {
    range.lower = std::fmin(range.lower, t);
    range.upper = std::fmax(range.upper, t);
  }
  if (!(range.lower < range.upper))
    return {std::isfinite(range.lower) ? range.lower - 0.5 : 0.0,
            std::isfinite(range.lower) ? range.lower + 0.5 : 1.0};
  return range;
}

/// Band value · exp(±2 sigma / value): parameters are positive, and their logarithm has the normal
/// distribution.
QCPRange bandOf(double value, double sigma) {
  const double factor = value > 0.0 ? std::exp(2.0 * sigma / value) : 1.0;
  return {value / factor, value * factor};
}

QCPRange valuesOf(const ConvergencePanel& data, const QCPRange& time) {
  double low = data.truth ? std::min(data.nominal, *data.truth) : data.nominal;
  double high = data.truth ? std::max(data.nominal, *data.truth) : data.nominal;
  for (std::size_t i = 0; i < data.t.size(); ++i) {
    if (!known(data, i)) continue;
    const bool late = data.t[i] >= time.lower + kBandFrom * time.size();
    const QCPRange band = bandOf(data.value[i], late && std::isfinite(data.sigma[i]) ? data.sigma[i] : 0.0);
    low = std::min(low, band.lower);
    high = std::max(high, band.upper);
  }
  const double margin = high > low ? 0.06 * (high - low) : std::max(0.05 * std::abs(low), 1e-6);
  return {low - margin, high + margin};
}

QCPItemLine* addLine(QCustomPlot* plot, QCPAxisRect* axes) {
  auto* line = new QCPItemLine(plot);
  for (auto* point : {line->start, line->end}) {
    point->setAxisRect(axes);
    point->setAxes(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
  }
  line->setClipAxisRect(axes);
  line->setVisible(false);
  return line;
}

void place(QCPItemLine* line, double x0, double y0, double x1, double y1) {
  line->start->setCoords(x0, y0);
  line->end->setCoords(x1, y1);
  line->setVisible(true);
}

QPen truthPen(const Theme& theme, double line) { return {theme.truth, 1.0 * line}; }

QPen nominalPen(const Theme& theme, double line) {
  QPen pen(theme.muted, 1.1 * line);
  pen.setDashPattern({5.0, 3.0});
  return pen;
}

QPen settledPen(const Theme& theme, double line) {
  QPen pen(theme.text, 1.0 * line);
  pen.setDashPattern({1.5, 2.5});
  return pen;
}

QPen valuePen(const Theme& theme, double line) {
  return {theme.colour(Quantity::kUkf), 2.0 * line, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin};
}

}  // namespace

ConvergenceFigure::ConvergenceFigure(ConvergenceData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  const QString explained = tr("numbers: at the end, ± 2σ");
  setTitle(data_.title, data_.note.isEmpty() ? explained : data_.note + QStringLiteral("; ") + explained);
  for (const ConvergencePanel& panel : data_.panels) build(panel);
  fit();
}

std::unique_ptr<Figure> ConvergenceFigure::copy() const { return std::make_unique<ConvergenceFigure>(data_); }

QString ConvergenceFigure::words(const ConvergencePanel& panel) const {
  QStringList parts;
  if (!panel.seen) {
    parts << tr("not observable");
    if (panel.truth)
      parts << tr("truth %1").arg(significantText(*panel.truth, 4)) + QLatin1Char(' ') + panel.unit;
    return unbroken(parts.join(QStringLiteral(", ")));
  }
  if (const auto last = lastOf(panel))
    parts << uncertainText(panel.value[*last], 2.0 * panel.sigma[*last]) + QLatin1Char(' ') + panel.unit;
  if (panel.truth) parts << tr("truth %1").arg(significantText(*panel.truth, 4));
  parts << (panel.settled_at ? tr("settled after %1 s").arg(*panel.settled_at, 0, 'f', 0)
                             : tr("not settled"));
  for (QString& part : parts) part = unbroken(part);
  return parts.join(QStringLiteral(", "));
}

void ConvergenceFigure::build(const ConvergencePanel& data) {
  setGroup(data.group);
  const Panel& panel =
      addPanel({{QStringLiteral("%1 [%2]").arg(data.title, data.unit), true}, {words(data), false}},
               tr("time [s]"), tr("estimate [%1]").arg(data.unit));
  shades_.push_back(new TimeShade(panel.axes, data_.occluded));
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  const QCPRange time = timeOf(data), values = valuesOf(data, time);
  x->setRange(time);
  y->setRange(values);
  Curves curves{};
  curves.band = new SigmaBand(panel.axes);
  curves.value = addGraph(x, y);
  curves.value->setAdaptiveSampling(false);
  curves.band->begin();
  QVector<double> t, value;
  for (std::size_t i = 0; i < data.t.size(); ++i) {
    t << data.t[i];
    value << (known(data, i) ? data.value[i] : base::kNaN);
    // SVG files have no clipping: the band is cut to the axis here.
    const QCPRange band = bandOf(value.back(), data.sigma[i]);
    curves.band->add(data.t[i], std::clamp(band.lower, values.lower, values.upper),
                     std::clamp(band.upper, values.lower, values.upper));
  }
  curves.value->setData(t, value, true);
  curves.nominal = addLine(this, panel.axes);
  place(curves.nominal, time.lower, data.nominal, time.upper, data.nominal);
  curves.truth = addLine(this, panel.axes);
  if (data.truth) place(curves.truth, time.lower, *data.truth, time.upper, *data.truth);
  curves.settled = addLine(this, panel.axes);
  if (data.settled_at) place(curves.settled, *data.settled_at, values.lower, *data.settled_at, values.upper);
  panel.empty->setVisible(!lastOf(data));
  curves_.push_back(curves);
}

int ConvergenceFigure::columnsFor(QSize size) const {
  const int panels = static_cast<int>(data_.panels.size());
  return panels <= kFewPanels ? 1 : std::clamp(size.width() / kLeastConvergenceWidth, 1, 2);
}

bool ConvergenceFigure::sharesX() const {
  return std::all_of(data_.panels.begin(), data_.panels.end(),
                     [&](const ConvergencePanel& panel) { return timeOf(panel) == timeOf(data_.panels[0]); });
}

void ConvergenceFigure::restyle() {
  const double line = scale().line;
  bool truth = false, settled = false;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const Curves& curves = curves_[i];
    curves.band->setColour(theme().band());
    curves.value->setPen(valuePen(theme(), line));
    curves.truth->setPen(truthPen(theme(), line));
    curves.nominal->setPen(nominalPen(theme(), line));
    curves.settled->setPen(settledPen(theme(), line));
    truth = truth || data_.panels[i].truth;
    settled = settled || data_.panels[i].settled_at;
  }
  std::vector<LegendEntry> entries = {
      lineEntry(tr("estimate ± 2σ"), valuePen(theme(), line), theme().band())};
  if (truth) entries.push_back(lineEntry(tr("truth"), truthPen(theme(), line)));
  entries.push_back(lineEntry(tr("nominal"), nominalPen(theme(), line)));
  for (TimeShade* shade : shades_) shade->setColour(theme().occluded);
  if (!data_.occluded.empty()) entries.push_back(areaEntry(tr("occluded"), theme().occluded));
  if (settled) entries.push_back(lineEntry(tr("settled"), settledPen(theme(), line)));
  setLegend(std::move(entries));
}

std::vector<FigureNumbers> ConvergenceFigure::numbers() const {
  std::string trace = "parameter,unit,t [s],value,sigma\n";
  std::string summary = "parameter,unit,value,sigma,truth,nominal,settled_at [s]\n";
  for (const ConvergencePanel& panel : data_.panels) {
    const std::string name = csvText(panel.title) + "," + csvText(panel.unit) + ",";
    for (std::size_t i = 0; i < panel.t.size(); ++i)
      trace += name + csvNumber(panel.t[i]) + "," + csvNumber(panel.value[i]) + "," +
               csvNumber(panel.sigma[i]) + "\n";
    const auto last = lastOf(panel);
    summary += name + csvNumber(last ? panel.value[*last] : base::kNaN) + "," +
               csvNumber(last ? panel.sigma[*last] : base::kNaN) + "," +
               csvNumber(panel.truth.value_or(base::kNaN)) + "," + csvNumber(panel.nominal) + "," +
               csvNumber(panel.settled_at.value_or(base::kNaN)) + "\n";
  }
  return {{"", trace}, {"_summary", summary}};
}

}  // namespace capstan::widgets
