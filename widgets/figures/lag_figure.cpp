#include "widgets/figures/lag_figure.h"

#include <algorithm>

#include "widgets/figures/figure_text.h"
#include "widgets/figures/legend_entries.h"

namespace capstan::widgets {

namespace {

constexpr double kMilli = 1e3;

QPen misfitPen(const Theme& theme, double line) { return {theme.text, 1.3 * line}; }
QPen lagPen(const Theme& theme, double line) { return {theme.accent, 1.8 * line}; }

}  // namespace

LagFigure::LagFigure(LagData data, QWidget* parent) : PanelFigure(parent), data_(std::move(data)) {
  setTitle(data_.title, data_.note);
  const learning::LagReport& lag = data_.lag;
  const Panel& panel =
      addPanel({}, tr("lag of what is seen behind what was told [ms]"), tr("misfit of speeds [mm/s]"));
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
  panel.empty->setVisible(lag.tried.empty());
  sigma_ = new SigmaBand(panel.axes);
  misfit_ = addGraph(x, y);
  QVector<double> keys, values;
  for (std::size_t k = 0; k < lag.tried.size(); ++k)
    keys << kMilli * lag.tried[k], values << kMilli * lag.misfit[k];
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
    lag_->start->setCoords(kMilli * lag.lag, y->range().lower);
    lag_->end->setCoords(kMilli * lag.lag, y->range().upper);
    sigma_->begin();
    for (const double end : {lag.lag - 2.0 * lag.sigma, lag.lag + 2.0 * lag.sigma})
      sigma_->add(std::clamp(kMilli * end, keys.front(), keys.back()), y->range().lower, y->range().upper);
  }
  fit();
}

std::unique_ptr<Figure> LagFigure::copy() const { return std::make_unique<LagFigure>(data_); }

void LagFigure::restyle() {
  const double line = scale().line;
  QColor band = theme().accent;
  band.setAlpha(60);
  misfit_->setPen(misfitPen(theme(), line));
  misfit_->setScatterStyle({QCPScatterStyle::ssDisc, theme().text, 3.2 * line});
  lag_->setPen(lagPen(theme(), line));
  sigma_->setColour(band);
  setLegend(
      {lineEntry(tr("mean |difference of speeds|"), misfitPen(theme(), line)),
       lineEntry(
           tr("lag ± 2σ: %1 ms").arg(uncertainText(kMilli * data_.lag.lag, 2.0 * kMilli * data_.lag.sigma)),
           lagPen(theme(), line), band)});
}

std::vector<FigureNumbers> LagFigure::numbers() const {
  std::string rows = "lag [ms],misfit [mm/s]\n";
  for (std::size_t k = 0; k < data_.lag.tried.size(); ++k)
    rows += csvNumber(kMilli * data_.lag.tried[k]) + "," + csvNumber(kMilli * data_.lag.misfit[k]) + "\n";
  return {{"", rows},
          {"_summary", "lag [ms],sigma [ms]\n" + csvNumber(kMilli * data_.lag.lag) + "," +
                           csvNumber(kMilli * data_.lag.sigma) + "\n"}};
}

}  // namespace capstan::widgets
