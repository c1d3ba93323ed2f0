#include "widgets/figures/histogram_figure.h"

#include <algorithm>
#include <cmath>

#include "core/base/nan.h"
#include "widgets/figures/common_bins.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/histogram_bars.h"

namespace capstan::widgets {

namespace {

constexpr double kHeadroom = 1.12;         ///< end of the value axis, relative to the highest bar
constexpr int kLeastHistogramWidth = 190;  ///< [px] of panels side by side

std::vector<double> finite(const std::vector<double>& values) {
  std::vector<double> kept;
  kept.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(kept),
               [](double x) { return std::isfinite(x); });
  return kept;
}

/// Keys of the series in the panels `shown`, each once, in order.
std::vector<SeriesKey> keysOf(const HistogramData& data, const std::vector<std::size_t>& shown) {
  std::vector<SeriesKey> keys;
  for (const std::size_t panel : shown)
    for (const HistogramSeries& series : data.panels[panel].series)
      if (std::find(keys.begin(), keys.end(), series.key) == keys.end()) keys.push_back(series.key);
  return keys;
}

std::vector<double> heightsOf(const stats::Histogram& histogram, bool density) {
  if (density) return histogram.density();
  return {histogram.counts.begin(), histogram.counts.end()};
}

}  // namespace

HistogramFigure::HistogramFigure(HistogramData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  compute();
  build();
  fit();
}

std::unique_ptr<Figure> HistogramFigure::copy() const { return std::make_unique<HistogramFigure>(data_); }

void HistogramFigure::compute() {
  for (const HistogramPanel& panel : data_.panels) {
    std::vector<std::vector<double>> kept;
    for (const HistogramSeries& series : panel.series) kept.push_back(finite(series.values));
    const auto bins = commonBins({kept.begin(), kept.end()});
    auto& results = results_.emplace_back();
    for (std::size_t i = 0; i < kept.size(); ++i) {
      Result result;
      result.n = kept[i].size();
      result.without_value = panel.series[i].values.size() - kept[i].size();
      result.mean = result.n > 0 ? stats::mean(kept[i]) : base::kNaN;
      result.sigma = result.n > 1 ? stats::standardDeviation(kept[i]) : base::kNaN;
      if (result.n > 0) result.histogram = stats::histogram(kept[i], bins->low, bins->high, bins->count);
      results.push_back(std::move(result));
    }
  }
}

QString HistogramFigure::words(std::size_t panel) const {
  const auto& results = results_[panel];
  QStringList parts;
  std::uint64_t outside = 0;
  std::size_t without = 0;
  const bool one_n =
      std::all_of(results.begin(), results.end(), [&](const Result& r) { return r.n == results[0].n; });
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& result = results[i];
    QString text = data_.panels[panel].series[i].key.name() + QLatin1Char(' ') +
                   significantText(result.mean) + QStringLiteral(" ± ") + significantText(result.sigma);
    if (!one_n) text += tr(" (n %1)").arg(result.n);
    parts << text;
    outside += result.histogram.underflow + result.histogram.overflow;
    without += result.without_value;
  }
  if (one_n && !results.empty()) parts << tr("n %1").arg(results[0].n);
  if (outside > 0) parts << tr("%1 beyond the axis").arg(outside);
  if (without > 0) parts << tr("%1 without a value").arg(without);
  for (QString& part : parts) part = unbroken(part);
  return parts.join(QStringLiteral(", "));
}

void HistogramFigure::build() {
  const QString explained = tr("numbers: mean ± standard deviation");
  setTitle(data_.title, data_.note.isEmpty() ? explained : data_.note + QStringLiteral("; ") + explained);
  for (std::size_t p = 0; p < data_.panels.size(); ++p) {
    const HistogramPanel& data = data_.panels[p];
    setGroup(data.group);
    const Panel& panel =
        addPanel({{QStringLiteral("%1 [%2]").arg(data.title, data.unit), true}, {words(p), false}},
                 QStringLiteral("%1 [%2]").arg(data_.quantity, data.unit),
                 data_.density ? tr("density [1/%1]").arg(data.unit) : tr("samples [–]"));
    double highest = 0.0, low = base::kNaN, high = base::kNaN;
    auto& bars = bars_.emplace_back();
    for (const Result& result : results_[p]) {
      bars.push_back(new HistogramBars(panel.axes));
      if (result.n == 0) continue;
      const auto heights = heightsOf(result.histogram, data_.density);
      highest = std::max(highest, *std::max_element(heights.begin(), heights.end()));
      low = result.histogram.edges.front();
      high = result.histogram.edges.back();
      bars.back()->setBars(result.histogram.edges, heights);
      bars.back()->setMean(result.mean);
    }
    panel.empty->setVisible(std::isnan(low));
    panel.axes->axis(QCPAxis::atLeft)->setRange(0.0, highest > 0.0 ? kHeadroom * highest : 1.0);
    const double margin = std::isnan(low) ? 0.0 : 0.02 * (high - low);
    panel.axes->axis(QCPAxis::atBottom)
        ->setRange(std::isnan(low) ? QCPRange(-1.0, 1.0) : QCPRange(low - margin, high + margin));
  }
}

/// Uses one row per group, if the groups have equal sizes and fit.
int HistogramFigure::columnsFor(QSize size) const {
  const int room = std::max(1, size.width() / kLeastHistogramWidth);
  const auto of_first = static_cast<int>(
      std::count_if(data_.panels.begin(), data_.panels.end(), [&](const HistogramPanel& panel) {
        return panel.group >= 0 && panel.group == data_.panels.front().group;
      }));
  return of_first > 1 ? std::min(room, of_first) : room;
}

void HistogramFigure::restyle() {
  std::vector<LegendEntry> entries;
  const double line = scale().line;
  for (const SeriesKey& key : keysOf(data_, shown())) {
    const SeriesStyle style = SeriesStyle::of(key, theme());
    entries.push_back({key.name(), [style, line](QCPPainter* painter, const QRectF& box) {
                         style.fillBox(painter, box, line);
                         painter->setPen(QPen(style.ink, 1.1 * line));
                         painter->drawRect(box);
                       }});
  }
  const QColor ink = theme().text;
  if (!entries.empty())
    entries.push_back(
        {tr("mean"), [ink, line](QCPPainter* painter, const QRectF& box) {
           painter->setPen(QPen(ink, 1.2 * line));
           const double x = box.center().x(), size = 3.0 * line;
           painter->drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()));
           painter->setBrush(ink);
           const QPointF mark[] = {{x - size, box.top()}, {x + size, box.top()}, {x, box.top() + 1.7 * size}};
           painter->drawPolygon(mark, 3);
         }});
  setLegend(std::move(entries));
  for (std::size_t p = 0; p < bars_.size(); ++p)
    for (std::size_t i = 0; i < bars_[p].size(); ++i)
      bars_[p][i]->setStyle(SeriesStyle::of(data_.panels[p].series[i].key, theme()), line);
}

std::vector<FigureNumbers> HistogramFigure::numbers() const {
  std::string bins = "panel,unit,series,bin_low,bin_high,count,density\n";
  std::string summary = "panel,unit,series,n,mean,sigma,below_axis,above_axis,without_value\n";
  for (std::size_t p = 0; p < data_.panels.size(); ++p)
    for (std::size_t i = 0; i < results_[p].size(); ++i) {
      const Result& result = results_[p][i];
      const std::string name = csvText(data_.panels[p].title) + "," + csvText(data_.panels[p].unit) + "," +
                               csvText(data_.panels[p].series[i].key.name());
      const stats::Histogram& histogram = result.histogram;
      const auto density = result.n > 0 ? histogram.density() : std::vector<double>();
      for (std::size_t k = 0; k < histogram.counts.size(); ++k)
        bins += name + "," + csvNumber(histogram.edges[k]) + "," + csvNumber(histogram.edges[k + 1]) + "," +
                std::to_string(histogram.counts[k]) + "," + csvNumber(density[k]) + "\n";
      summary += name + "," + std::to_string(result.n) + "," + csvNumber(result.mean) + "," +
                 csvNumber(result.sigma) + "," + std::to_string(histogram.underflow) + "," +
                 std::to_string(histogram.overflow) + "," + std::to_string(result.without_value) + "\n";
    }
  return {{"", bins}, {"_summary", summary}};
}

}  // namespace capstan::widgets
