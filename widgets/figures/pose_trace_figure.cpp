#include "widgets/figures/pose_trace_figure.h"

#include <algorithm>
#include <limits>

#include "core/learning/evaluation/correction_errors.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"

namespace capstan::widgets {

namespace {

constexpr double kObservationGap = 10.0;  ///< shortest shaded gap without observations, in periods
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kLeastTraceWidth = 280;                              ///< [px] of panels side by side
constexpr std::array<std::size_t, 6> kOrder = {0, 3, 1, 4, 2, 5};  ///< positions left, angles right

/// Observations that are not drawn as lines: rejected ones, unless all are rejected.
std::vector<bool> leftOut(const PoseTraceData& data) {
  const bool all = std::find(data.rejected.begin(), data.rejected.end(), false) == data.rejected.end();
  return all ? std::vector<bool>(data.rejected.size(), false) : data.rejected;
}

/// Value range of the axes without excluded observations: these are drawn at the edge, and do not compress
/// the rest.
QCPRange rangeOf(const PoseTraceData& data, const std::vector<bool>& excluded, std::size_t degree) {
  QCPRange range;
  bool first = true;
  for (const auto& history : data.history)
    for (std::size_t k = 0; k < history[degree].size(); ++k) {
      if (excluded[k] && &history != &data.history.front()) continue;
      if (first) range = {history[degree][k], history[degree][k]};
      range.expand(history[degree][k]);
      first = false;
    }
  const double margin = std::max(0.08 * range.size(), 0.5);
  return {range.lower - margin, range.upper + margin};
}

}  // namespace

PoseTraceFigure::PoseTraceFigure(PoseTraceData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  for (const std::size_t degree : kOrder) build(degree);
  fit();
}

std::unique_ptr<Figure> PoseTraceFigure::copy() const { return std::make_unique<PoseTraceFigure>(data_); }

void PoseTraceFigure::build(std::size_t degree) {
  const QString name = QString::fromUtf8(learning::kDegreesOfFreedom[degree]);
  const QString unit = degree < 3 ? tr("mm") : tr("deg");
  setGroup(degree < 3 ? 0 : 1);
  const Panel& panel = addPanel({{QStringLiteral("%1 [%2]").arg(name, unit), true}}, tr("time [s]"),
                                QStringLiteral("%1 [%2]").arg(name, unit));
  gaps_.push_back(new TimeShade(panel.axes, gapsIn(data_.t, kObservationGap * typicalPeriod(data_.t))));
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  panel.empty->setVisible(data_.t.empty());
  if (!data_.t.empty()) x->setRange(data_.t.front(), data_.t.back());
  const std::vector<bool> excluded = leftOut(data_);
  const QCPRange range = rangeOf(data_, excluded, degree);
  y->setRange(range);
  Curves curves{};
  const double longest = kObservationGap * typicalPeriod(data_.t);
  // The last estimate is drawn first and the commanded pose last, so that each stays visible where they
  // coincide.
  for (const std::size_t s : {std::size_t{1}, std::size_t{2}, std::size_t{0}}) {
    curves.history[s] = addGraph(x, y);
    curves.history[s]->setAdaptiveSampling(false);
    QVector<double> t, history;
    for (std::size_t k = 0; k < data_.history[s][degree].size(); ++k) {
      const bool gap = k > 0 && data_.t[k] - data_.t[k - 1] > longest;
      if (gap) t << data_.t[k - 1], history << kNone;
      t << data_.t[k];
      history << (s > 0 && excluded[k] ? kNone : data_.history[s][degree][k]);
    }
    curves.history[s]->setData(t, history, true);
  }
  curves.rejected = addGraph(x, y);
  curves.rejected->setLineStyle(QCPGraph::lsNone);
  QVector<double> when, where;
  for (std::size_t k = 0; k < data_.t.size(); ++k)
    if (data_.rejected[k] && !data_.history[1][degree].empty())
      when << data_.t[k], where << std::clamp(data_.history[1][degree][k], range.lower, range.upper);
  curves.rejected->setData(when, where, true);
  curves_.push_back(curves);
}

int PoseTraceFigure::columnsFor(QSize size) const { return size.width() >= 2 * kLeastTraceWidth ? 2 : 1; }

QPen PoseTraceFigure::penOf(PoseSource source) const {
  QPen pen = theme().pen(quantityOf(source));
  pen.setWidthF(scale().line * (source == PoseSource::kCommanded ? 0.9
                                : source == PoseSource::kOffset  ? 1.3
                                                                 : 2.4));
  return pen;
}

void PoseTraceFigure::restyle() {
  const QCPScatterStyle mark(QCPScatterStyle::ssCross, QPen(theme().warning, 1.4 * scale().line), Qt::NoBrush,
                             5.5 * scale().line);
  std::vector<LegendEntry> entries;
  for (std::size_t s = 0; s < kSources.size(); ++s) {
    for (const Curves& curves : curves_) curves.history[s]->setPen(penOf(kSources[s]));
    if (!data_.history[s][0].empty()) entries.push_back(lineEntry(nameOf(kSources[s]), penOf(kSources[s])));
  }
  for (const Curves& curves : curves_) curves.rejected->setScatterStyle(mark);
  if (std::find(data_.rejected.begin(), data_.rejected.end(), true) != data_.rejected.end())
    entries.push_back(markEntry(tr("rejected"), mark));
  for (TimeShade* gap : gaps_) gap->setColour(theme().occluded);
  if (!gaps_.front()->intervals().empty())
    entries.push_back(areaEntry(tr("occluded: no observation"), theme().occluded));
  setLegend(std::move(entries));
}

std::vector<FigureNumbers> PoseTraceFigure::numbers() const {
  std::string rows = "t [s],rejected";
  for (std::size_t s = 0; s < kSources.size(); ++s)
    for (std::size_t d = 0; d < 6; ++d)
      if (!data_.history[s][d].empty())
        rows += "," +
                csvText(nameOf(kSources[s]) + QLatin1Char(' ') +
                        QString::fromUtf8(learning::kDegreesOfFreedom[d])) +
                (d < 3 ? " [mm]" : " [deg]");
  rows += '\n';
  for (std::size_t k = 0; k < data_.t.size(); ++k) {
    rows += csvNumber(data_.t[k]) + (data_.rejected[k] ? ",1" : ",0");
    for (const auto& history : data_.history)
      for (const std::vector<double>& values : history)
        if (!values.empty()) rows += "," + csvNumber(values[k]);
    rows += '\n';
  }
  return {{"", rows}};
}

}  // namespace capstan::widgets
