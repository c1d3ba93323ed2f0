#include "widgets/figures/boxplot_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "widgets/figures/box_series.h"
#include "widgets/figures/figure_text.h"

namespace capstan::widgets {

namespace {

constexpr double kGroupWidth = 0.84;  ///< width of a group's boxes; groups are 1 apart
constexpr double kBoxShare = 0.78;    ///< width of a box, as a share of its slot
constexpr double kFarOutlier = 1.0;   ///< in ranges of the whiskers; farther outliers are only counted
constexpr int kLeastBoxWidth = 24;    ///< [px] where panels stand side by side

std::vector<SeriesKey> keysOf(const std::vector<BoxplotPanel>& panels) {
  std::vector<SeriesKey> keys;
  for (const BoxplotPanel& panel : panels)
    for (const BoxplotGroup& group : panel.groups)
      for (const BoxplotBox& box : group.boxes)
        if (std::find(keys.begin(), keys.end(), box.key) == keys.end()) keys.push_back(box.key);
  return keys;
}

/// Visible range of values: whiskers of all boxes, and outliers that are not too far from them.
std::optional<QCPRange> valuesOf(const BoxplotPanel& panel) {
  std::optional<QCPRange> whiskers;
  const auto include = [](std::optional<QCPRange>& range, double low, double high) {
    range = range ? QCPRange(std::min(range->lower, low), std::max(range->upper, high)) : QCPRange(low, high);
  };
  for (const BoxplotGroup& group : panel.groups)
    for (const BoxplotBox& box : group.boxes)
      if (box.statistics.n > 0) include(whiskers, box.statistics.lower_whisker, box.statistics.upper_whisker);
  if (!whiskers) return std::nullopt;
  std::optional<QCPRange> all = whiskers;
  const double reach = kFarOutlier * whiskers->size();
  for (const BoxplotGroup& group : panel.groups)
    for (const BoxplotBox& box : group.boxes)
      for (const double value : box.statistics.outliers)
        if (value >= whiskers->lower - reach && value <= whiskers->upper + reach) include(all, value, value);
  return all;
}

/// Adds [–] to the label of groups without a unit.
QString withUnit(const QString& label) {
  return label.contains(QLatin1Char('[')) ? label : label + QStringLiteral(" [–]");
}

/// Number of samples as "37600", or both numbers where the boxes of a group differ; with `brief` "38k".
QString countText(const BoxplotGroup& group, bool brief) {
  QStringList counts;
  for (const BoxplotBox& box : group.boxes) {
    const auto n = static_cast<double>(box.statistics.n);
    const QString text = brief && n >= 1000.0
                             ? QStringLiteral("%1k").arg(n / 1000.0, 0, 'f', n < 9950.0 ? 1 : 0)
                             : QString::number(box.statistics.n);
    if (!counts.contains(text)) counts << text;
  }
  return counts.join(QLatin1Char('|'));
}

}  // namespace

stats::Boxplot boxplotOf(const std::vector<double>& values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double x) { return std::isfinite(x); });
  return finite.empty() ? stats::Boxplot{} : stats::boxplot(finite);
}

std::vector<double> thinned(const std::vector<double>& values, std::size_t most) {
  if (values.size() <= most || most < 2) return values;
  std::vector<double> kept;
  for (std::size_t i = 0; i < most; ++i) kept.push_back(values[i * (values.size() - 1) / (most - 1)]);
  return kept;
}

BoxplotFigure::BoxplotFigure(BoxplotData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  build();
  fit();
}

std::unique_ptr<Figure> BoxplotFigure::copy() const { return std::make_unique<BoxplotFigure>(data_); }

QString BoxplotFigure::outlierWords() const {
  if (outliers_ == outliers_drawn_) return {};
  return tr("%1 of %2 outliers drawn").arg(outliers_drawn_).arg(outliers_);
}

void BoxplotFigure::build() {
  for (const BoxplotPanel& panel : data_.panels) buildPanel(panel);
  QStringList note;
  if (!data_.note.isEmpty()) note << data_.note;
  note << tr("box: quartiles; whiskers: within 1.5 interquartile ranges; numbers: medians");
  if (!outlierWords().isEmpty()) note << outlierWords();
  setTitle(data_.title, note.join(QStringLiteral("; ")));
}

void BoxplotFigure::buildPanel(const BoxplotPanel& data) {
  const Panel& panel = addPanel(
      {{QStringLiteral("%1 [%2]").arg(data.title, data.unit), true}},
      tr("%1, n below").arg(withUnit(data.x_label)),
      QStringLiteral("%1 [%2]").arg(data_.quantity.isEmpty() ? data.title : data_.quantity, data.unit));
  Drawn drawn;
  const auto values = valuesOf(data);
  panel.empty->setVisible(!values);
  drawn.values = values.value_or(QCPRange(0.0, 1.0));
  const std::vector<SeriesKey> keys = keysOf({data});
  drawn.slot = kGroupWidth / static_cast<double>(std::max<std::size_t>(keys.size(), 1));
  for (std::size_t k = 0; k < keys.size(); ++k) {
    std::vector<BoxSeries::Box> boxes;
    for (std::size_t g = 0; g < data.groups.size(); ++g)
      for (const BoxplotBox& box : data.groups[g].boxes) {
        if (!(box.key == keys[k]) || box.statistics.n == 0) continue;
        const double x =
            static_cast<double>(g + 1) - 0.5 * kGroupWidth + (static_cast<double>(k) + 0.5) * drawn.slot;
        boxes.push_back({x, 0.5 * kBoxShare * drawn.slot, box.statistics,
                         thinned(box.statistics.outliers, kMostOutliers)});
        outliers_ += box.statistics.outliers.size();
        outliers_drawn_ += boxes.back().outliers.size();
      }
    auto* series = new BoxSeries(panel.axes);
    series->setBoxes(std::move(boxes));
    series->setSeen(drawn.values);
    drawn.series.emplace_back(keys[k], series);
  }
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  x->setRange(0.5, std::max(1.0, static_cast<double>(data.groups.size())) + 0.5);
  x->grid()->setVisible(false);
  drawn_.push_back(std::move(drawn));
  labelGroups(drawn_.size() - 1);
}

int BoxplotFigure::columnsFor(QSize size) const {
  std::size_t boxes = 1;
  for (const BoxplotPanel& panel : data_.panels)
    boxes = std::max(boxes, panel.groups.size() * keysOf({panel}).size());
  const int fitting = std::max(1, size.width() / (60 + kLeastBoxWidth * static_cast<int>(boxes)));
  return data_.most_columns > 0 ? std::min(fitting, data_.most_columns) : fitting;
}

void BoxplotFigure::restyle() {
  std::vector<LegendEntry> entries;
  const double line = scale().line;
  for (const SeriesKey& key : keysOf(data_.panels)) {
    const SeriesStyle style = SeriesStyle::of(key, theme());
    entries.push_back({key.name(), [style, line](QCPPainter* painter, const QRectF& box) {
                         style.fillBox(painter, box, line);
                         painter->setPen(style.pen(1.1 * line));
                         painter->drawRect(box);
                       }});
  }
  setLegend(std::move(entries));
  for (Drawn& drawn : drawn_)
    for (auto& [key, series] : drawn.series)
      series->setStyle(SeriesStyle::of(key, theme()), theme().text, line, scale().tick - 0.5);
}

/// Writes medians horizontally or upright, and extends the value axis to make room for them.
void BoxplotFigure::laidOut() {
  for (std::size_t p = 0; p < drawn_.size(); ++p) {
    QCPAxisRect* axes = panels()[p].axes;
    const Drawn& drawn = drawn_[p];
    labelGroups(p);
    const double slot = drawn.slot * axes->width() / axes->axis(QCPAxis::atBottom)->range().size();
    double widest = 0.0, top = 3.0, bottom = 3.0;
    for (const auto& [key, series] : drawn.series) widest = std::max(widest, series->widestNumber());
    for (const auto& [key, series] : drawn.series) {
      series->setUpright(widest + 3.0 > slot);
      top = std::max(top, series->headroom());
      bottom = std::max(bottom, series->footroom());
    }
    const double height = std::max(axes->height() - top - bottom, 10.0);
    double span = drawn.values.size();
    if (!(span > 0.0)) span = std::max(0.1 * std::abs(drawn.values.lower), 1e-6);
    const double middle = drawn.values.center(), pixel = span / height;
    axes->axis(QCPAxis::atLeft)
        ->setRange(middle - 0.5 * span - bottom * pixel, middle + 0.5 * span + top * pixel);
  }
}

/// The height for the numbers above and below the boxes is added to the least height.
int BoxplotFigure::leastHeight(std::size_t panel) const {
  double top = 0.0, bottom = 0.0;
  for (const auto& [key, series] : drawn_[panel].series) {
    top = std::max(top, series->headroom());
    bottom = std::max(bottom, series->footroom());
  }
  return kLeastAxesHeight + static_cast<int>(top + bottom);
}

void BoxplotFigure::labelGroups(std::size_t p) {
  const BoxplotPanel& data = data_.panels[p];
  QCPAxisRect* axes = panels()[p].axes;
  const QFontMetricsF metrics(textFont(scale().tick));
  const double room = axes->width() / axes->axis(QCPAxis::atBottom)->range().size() - 2.0;
  bool brief = false;
  for (const BoxplotGroup& group : data.groups)
    brief = brief || metrics.horizontalAdvance(countText(group, false)) > room;
  const auto ticker = QSharedPointer<QCPAxisTickerText>::create();
  for (std::size_t g = 0; g < data.groups.size(); ++g)
    ticker->addTick(static_cast<double>(g + 1),
                    data.groups[g].label + QLatin1Char('\n') + countText(data.groups[g], brief));
  axes->axis(QCPAxis::atBottom)->setTicker(ticker);
}

std::vector<FigureNumbers> BoxplotFigure::numbers() const {
  std::string boxes =
      "panel,unit,group,series,n,lower_whisker,first_quartile,median,third_quartile,upper_whisker,outliers,"
      "outliers_drawn\n";
  std::string outliers = "panel,unit,group,series,outlier\n";
  for (const BoxplotPanel& panel : data_.panels)
    for (const BoxplotGroup& group : panel.groups)
      for (const BoxplotBox& box : group.boxes) {
        const stats::Boxplot& s = box.statistics;
        const std::string name = csvText(panel.title) + "," + csvText(panel.unit) + "," +
                                 csvText(group.label) + "," + csvText(box.key.name());
        boxes += name + "," + std::to_string(s.n);
        for (const double value :
             {s.lower_whisker, s.first_quartile, s.median, s.third_quartile, s.upper_whisker})
          boxes += "," + (s.n > 0 ? csvNumber(value) : std::string());
        boxes += "," + std::to_string(s.outliers.size()) + "," +
                 std::to_string(std::min(s.outliers.size(), kMostOutliers)) + "\n";
        for (const double value : s.outliers) outliers += name + "," + csvNumber(value) + "\n";
      }
  return {{"", boxes}, {"_outliers", outliers}};
}

}  // namespace capstan::widgets
