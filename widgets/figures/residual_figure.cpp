#include "widgets/figures/residual_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/nan.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/figures/channel_note.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"

namespace capstan::widgets {

namespace {

using diagnosis::ShownUnit;
using diagnosis::shownUnit;

constexpr double kLineGap = 5.0;   ///< shortest gap that interrupts a line, in periods
constexpr int kMostSmooth = 6000;  ///< lines with more points are drawn pixel by pixel

QString fromUtf8(const std::string& text) { return QString::fromStdString(text); }

std::vector<double> residualOf(const ResidualTrace& trace, const std::vector<double>& simulated) {
  std::vector<double> e(simulated.size());
  for (std::size_t i = 0; i < e.size(); ++i) e[i] = trace.measured[i] - simulated[i];
  return e;
}

QCPRange rangeOf(std::initializer_list<const std::vector<double>*> all, double scale) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto* values : all)
    for (const double x : *values) low = std::min(low, scale * x), high = std::max(high, scale * x);
  if (!(low < high)) return {std::isfinite(low) ? low - 1.0 : -1.0, std::isfinite(low) ? low + 1.0 : 1.0};
  return {low - 0.04 * (high - low), high + 0.04 * (high - low)};
}

/// Text as "RMS 0.81 nominal, 0.52 refitted, 0.11 extended; noise 0.02; fit 98.1 → 99.7 %".
QString words(const ResidualTrace& trace) {
  const double scale = shownUnit(trace.unit).scale;
  const auto number = [&](double value) { return significantText(scale * value); };
  const bool extended = !trace.extended.empty();
  QString rms = QObject::tr("RMS %1 nominal, %2 refitted")
                    .arg(number(trace.nominal_statistics.rms), number(trace.refitted_statistics.rms));
  if (extended) rms += QObject::tr(", %1 extended").arg(number(trace.extended_statistics.rms));
  const double before = trace.refitted_statistics.fit, after = trace.extended_statistics.fit;
  QString fit = QObject::tr("fit %1").arg(significantText(before, 4));
  if (extended) fit += QStringLiteral(" → ") + significantText(after, 4);
  QStringList parts{unbroken(rms), unbroken(fit + QStringLiteral(" %"))};
  if (trace.noise > 0.0) parts.insert(1, unbroken(QObject::tr("sensor noise %1").arg(number(trace.noise))));
  return parts.join(QStringLiteral("; "));
}

QString nameOf(ResidualFigure::Line line, bool extended) {
  using Line = ResidualFigure::Line;
  return line == Line::kMeasured   ? QObject::tr("measured")
         : line == Line::kNominal  ? QObject::tr("nominal")
         : line == Line::kExtended ? QObject::tr("extended (after)")
         : extended                ? QObject::tr("refitted (before)")
                                   : QObject::tr("refitted");
}

}  // namespace

ResidualTrace residualTrace(const diagnosis::ChannelReport& channel, bool extended) {
  const diagnosis::Channel& of = channel.refitted;
  return {.channel = of.name,
          .unit = of.unit,
          .noise = of.noise,
          .period = of.period,
          .t = of.t,
          .measured = of.measured,
          .nominal = channel.nominal.simulated,
          .refitted = of.simulated,
          .extended = extended ? channel.extended.simulated : std::vector<double>(),
          .nominal_statistics = channel.nominal_statistics,
          .refitted_statistics = channel.refitted_statistics,
          .extended_statistics = channel.extended_statistics};
}

ResidualData residualData(const diagnosis::Report& report, const diagnosis::ChannelReport& channel) {
  ResidualData data;
  data.title = QObject::tr("%1: measured and simulated").arg(fromUtf8(channel.refitted.name));
  data.note = channelNote(report, channel);
  data.traces.push_back(residualTrace(channel, !report.causes.empty()));
  return data;
}

ResidualFigure::ResidualFigure(ResidualData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  for (const ResidualTrace& trace : data_.traces) build(trace);
  linkTimes();
  fit();
}

std::unique_ptr<Figure> ResidualFigure::copy() const { return std::make_unique<ResidualFigure>(data_); }

void ResidualFigure::build(const ResidualTrace& trace) {
  const QString channel = fromUtf8(trace.channel), unit = fromUtf8(shownUnit(trace.unit).unit);
  const double scale = shownUnit(trace.unit).scale;
  const bool extended = !trace.extended.empty();
  const std::vector<TimeInterval> gaps = gapsIn(trace.t, kLineGap * trace.period);
  setGroup(static_cast<int>(noise_.size()));
  const QCPRange time = trace.t.size() > 1 ? QCPRange(trace.t.front(), trace.t.back()) : QCPRange(0.0, 1.0);
  const auto dress = [&](const Panel& panel, const QCPRange& values) {
    panel.axes->axis(QCPAxis::atBottom)->setRange(time);
    panel.axes->axis(QCPAxis::atLeft)->setRange(values);
    panel.empty->setVisible(trace.t.empty());
    gaps_.push_back(new TimeShade(panel.axes, gaps));
    return panel.axes;
  };
  QCPAxisRect* traces =
      dress(addPanel({{QStringLiteral("%1 [%2]").arg(channel, unit), true}}, tr("time [s]"),
                     QStringLiteral("%1 [%2]").arg(channel, unit)),
            rangeOf({&trace.measured, &trace.nominal, &trace.refitted, &trace.extended}, scale));
  if (extended) addLine(traces, Line::kExtended, trace, trace.extended, false);
  addLine(traces, Line::kRefitted, trace, trace.refitted, false);
  addLine(traces, Line::kNominal, trace, trace.nominal, false);
  addLine(traces, Line::kMeasured, trace, trace.measured, false);

  const std::vector<double> before = residualOf(trace, trace.refitted),
                            after = residualOf(trace, trace.extended);
  const QCPRange values = rangeOf({&before, &after}, scale);
  QCPAxisRect* residual =
      dress(addPanel({{tr("%1: measured − simulated [%2]").arg(channel, unit), true}, {words(trace), false}},
                     tr("time [s]"), tr("residual [%1]").arg(unit)),
            values);
  noise_.push_back(new SigmaBand(residual));
  const double two_sigma = 2.0 * scale * trace.noise;
  noise_.back()->begin();
  for (const double t : {time.lower, time.upper})
    noise_.back()->add(t, std::clamp(-two_sigma, values.lower, values.upper),
                       std::clamp(two_sigma, values.lower, values.upper));
  addLine(residual, Line::kRefitted, trace, before, true);
  if (extended) addLine(residual, Line::kExtended, trace, after, true);
}

void ResidualFigure::addLine(QCPAxisRect* axes, Line line, const ResidualTrace& trace,
                             const std::vector<double>& values, bool residual) {
  QCPGraph* graph = addGraph(axes->axis(QCPAxis::atBottom), axes->axis(QCPAxis::atLeft));
  const double scale = shownUnit(trace.unit).scale;
  QVector<double> t, value;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && trace.t[i] - trace.t[i - 1] > kLineGap * trace.period) {
      t << 0.5 * (trace.t[i] + trace.t[i - 1]);
      value << base::kNaN;
    }
    t << trace.t[i];
    value << scale * values[i];
  }
  graph->setAdaptiveSampling(t.size() > kMostSmooth);
  graph->setData(t, value, true);
  curves_.push_back({line, graph, residual});
}

void ResidualFigure::linkTimes() {
  for (const Panel& from : panels())
    for (const Panel& to : panels())
      if (from.axes != to.axes)
        connect(from.axes->axis(QCPAxis::atBottom), qOverload<const QCPRange&>(&QCPAxis::rangeChanged),
                to.axes->axis(QCPAxis::atBottom), qOverload<const QCPRange&>(&QCPAxis::setRange));
}

/// The lines over time coincide: each stays visible below the thinner ones drawn over it.
QPen ResidualFigure::penOf(Line line, bool residual) const {
  const double width = scale().line;
  QPen pen(theme().truth, 0.8 * width);
  if (line == Line::kNominal) pen = QPen(theme().muted, 1.0 * width, Qt::DotLine);
  if (line == Line::kRefitted)
    pen = QPen(theme().colour(Quantity::kKinematic), (residual ? 1.1 : 1.8) * width);
  if (line == Line::kExtended) pen = QPen(theme().colour(Quantity::kUkf), (residual ? 1.1 : 3.4) * width);
  pen.setCapStyle(Qt::FlatCap);
  return pen;
}

void ResidualFigure::restyle() {
  std::vector<Line> lines;
  for (const Curve& curve : curves_) {
    curve.graph->setPen(penOf(curve.line, curve.residual));
    if (std::find(lines.begin(), lines.end(), curve.line) == lines.end()) lines.push_back(curve.line);
  }
  QColor shade = theme().muted;
  shade.setAlpha(60);
  for (SigmaBand* band : noise_) band->setColour(shade);
  for (const Panel& panel : panels())
    panel.axes->axis(QCPAxis::atLeft)->grid()->setZeroLinePen(QPen(theme().muted, 0.8 * scale().line));
  std::sort(lines.begin(), lines.end());
  std::vector<LegendEntry> entries;
  for (const Line line : lines)
    entries.push_back({nameOf(line, lines.back() == Line::kExtended),
                       [pen = penOf(line, false)](QCPPainter* painter, const QRectF& box) {
                         painter->setPen(pen);
                         painter->drawLine(QPointF(box.left(), box.center().y()),
                                           QPointF(box.right(), box.center().y()));
                       }});
  entries.push_back({tr("sensor noise ± 2σ"),
                     [shade](QCPPainter* painter, const QRectF& box) { painter->fillRect(box, shade); }});
  bool some = false;
  for (TimeShade* gap : gaps_) {
    gap->setColour(theme().occluded);
    some = some || !gap->intervals().empty();
  }
  if (some) entries.push_back(areaEntry(tr("occluded: no sample"), theme().occluded));
  setLegend(std::move(entries));
}

std::vector<FigureNumbers> ResidualFigure::numbers() const {
  std::string rows = "channel,unit,t [s],measured,nominal,refitted,extended\n";
  std::string summary = "channel,unit,model,rms,mean,fit [%],noise,beyond_noise,whiteness_p\n";
  for (const ResidualTrace& trace : data_.traces) {
    const ShownUnit unit = shownUnit(trace.unit);
    const std::string name = csvText(fromUtf8(trace.channel)) + "," + unit.unit + ",";
    const std::size_t stride = std::max<std::size_t>(1, (trace.t.size() + kMostRows - 1) / kMostRows);
    for (std::size_t i = 0; i < trace.t.size(); i += stride) {
      rows += name + csvNumber(trace.t[i]);
      for (const auto* values : {&trace.measured, &trace.nominal, &trace.refitted})
        rows += "," + csvNumber(unit.scale * (*values)[i]);
      rows += "," + csvNumber(trace.extended.empty() ? base::kNaN : unit.scale * trace.extended[i]) + "\n";
    }
    for (const auto& [model, statistics] : {std::pair{"nominal", &trace.nominal_statistics},
                                            {"refitted", &trace.refitted_statistics},
                                            {"extended", &trace.extended_statistics}})
      if (statistics != &trace.extended_statistics || !trace.extended.empty())
        summary += name + model + "," + csvNumber(unit.scale * statistics->rms) + "," +
                   csvNumber(unit.scale * statistics->mean) + "," + csvNumber(statistics->fit) + "," +
                   csvNumber(unit.scale * statistics->noise) + "," + csvNumber(statistics->beyond_noise) +
                   "," + csvNumber(statistics->whiteness.p_value) + "\n";
  }
  return {{"", rows}, {"_summary", summary}};
}

}  // namespace capstan::widgets
