#include "widgets/figures/clock_offset_figure.h"

#include <algorithm>

#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"

namespace capstan::widgets {

namespace {

constexpr double kMilli = 1e3;

QPen misfitPen(const Theme& theme, double line) { return {theme.text, 1.3 * line}; }
QPen clockOffsetPen(const Theme& theme, double line) { return {theme.accent, 1.8 * line}; }

}  // namespace

ClockOffsetFigure::ClockOffsetFigure(ClockOffsetData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  const learning::ClockOffsetReport& clock_offset = data_.clock_offset;
  const Panel& panel =
      addPanel({}, tr("clock offset of observations behind commands [ms]"), tr("misfit of speeds [mm/s]"));
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  panel.empty->setVisible(clock_offset.tried.empty());
  sigma_ = new SigmaBand(panel.axes);
  misfit_ = addGraph(x, y);
  QVector<double> keys, values;
  for (std::size_t k = 0; k < clock_offset.tried.size(); ++k)
    keys << kMilli * clock_offset.tried[k], values << kMilli * clock_offset.misfit[k];
  misfit_->setData(keys, values, true);
  lag_ = new QCPItemLine(this);
  for (auto* point : {lag_->start, lag_->end}) {
    point->setAxisRect(panel.axes);
    point->setAxes(x, y);
  }
  if (!keys.isEmpty()) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double margin = std::max(0.06 * (*high - *low), 1e-3);
    x->setRange(keys.front(), keys.back());
    y->setRange(*low - margin, *high + margin);
    lag_->start->setCoords(kMilli * clock_offset.clock_offset, y->range().lower);
    lag_->end->setCoords(kMilli * clock_offset.clock_offset, y->range().upper);
    sigma_->begin();
    for (const double end : {clock_offset.clock_offset - 2.0 * clock_offset.sigma,
                             clock_offset.clock_offset + 2.0 * clock_offset.sigma})
      sigma_->add(std::clamp(kMilli * end, keys.front(), keys.back()), y->range().lower, y->range().upper);
  }
  fit();
}

std::unique_ptr<Figure> ClockOffsetFigure::copy() const { return std::make_unique<ClockOffsetFigure>(data_); }

void ClockOffsetFigure::restyle() {
  const double line = scale().line;
  QColor band = theme().accent;
  band.setAlpha(60);
  misfit_->setPen(misfitPen(theme(), line));
  misfit_->setScatterStyle({QCPScatterStyle::ssDisc, theme().text, 3.2 * line});
  lag_->setPen(clockOffsetPen(theme(), line));
  sigma_->setColour(band);
  setLegend({lineEntry(tr("mean |difference of speeds|"), misfitPen(theme(), line)),
             lineEntry(tr("lag ± 2σ: %1 ms")
                           .arg(uncertainText(kMilli * data_.clock_offset.clock_offset,
                                              2.0 * kMilli * data_.clock_offset.sigma)),
                       clockOffsetPen(theme(), line), band)});
}

std::vector<FigureNumbers> ClockOffsetFigure::numbers() const {
  std::string rows = "lag [ms],misfit [mm/s]\n";
  for (std::size_t k = 0; k < data_.clock_offset.tried.size(); ++k)
    rows += csvNumber(kMilli * data_.clock_offset.tried[k]) + "," +
            csvNumber(kMilli * data_.clock_offset.misfit[k]) + "\n";
  return {{"", rows},
          {"_summary", "lag [ms],sigma [ms]\n" + csvNumber(kMilli * data_.clock_offset.clock_offset) + "," +
                           csvNumber(kMilli * data_.clock_offset.sigma) + "\n"}};
}

}  // namespace capstan::widgets
