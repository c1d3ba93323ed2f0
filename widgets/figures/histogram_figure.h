#pragma once

#include <vector>

#include "core/stats/histogram.h"
#include "core/stats/rms.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/series_style.h"

namespace capstan::widgets {

class HistogramBars;

struct HistogramSeries {
  SeriesKey key;
  std::vector<double> values;  ///< in the panel's unit; not finite: excluded and counted
};

struct HistogramPanel {
  QString title;  ///< for example "shoulder q1"
  QString unit;   ///< for example "deg"
  std::vector<HistogramSeries> series;
  int group = -1;  ///< panels of one group share a page; −1: a group of its own
};

struct HistogramData {
  QString title = {}, note = {};
  QString quantity = QStringLiteral("error");  ///< quantity on the x axes
  bool density = false;                        ///< true: density, share per unit; false: counts
  std::vector<HistogramPanel> panels = {};
};

/// Error histograms, one panel per joint, with series overlaid in common bins (common_bins.h). The mean of
/// each series is marked; mean, standard deviation and number of samples are written above (UKF paper, figure
/// 9).
class HistogramFigure : public PanelFigure {
  Q_OBJECT
 public:
  /// Series are in the order of drawing, the last on top.
  explicit HistogramFigure(HistogramData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const HistogramData& data() const { return data_; }

  /// Statistics of a series. For a series without a sample, n is 0 and the histogram has no bin.
  struct Result {
    stats::Histogram histogram;
    std::size_t n = 0, without_value = 0;
    double mean = 0.0, sigma = 0.0;  ///< of all finite samples, in the axes or not; NaN: unknown
  };
  const std::vector<std::vector<Result>>& results() const { return results_; }  ///< by panel and series

 protected:
  int columnsFor(QSize size) const override;
  void restyle() override;

 private:
  void compute();
  void build();
  QString words(std::size_t panel) const;

  HistogramData data_;
  std::vector<std::vector<Result>> results_;
  std::vector<std::vector<HistogramBars*>> bars_;
};

}  // namespace capstan::widgets
