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
  std::vector<double> values;  ///< in the panel's unit; those that are not finite are excluded, and counted
};

struct HistogramPanel {
  QString title;  ///< as "shoulder q1"
  QString unit;   ///< as "deg"
  std::vector<HistogramSeries> series;
  int group = -1;  ///< panels of one group stand on one page; −1: a group of its own
};

struct HistogramData {
  QString title = {}, note = {};
  QString quantity = QStringLiteral("error");  ///< of the x axes
  bool density = false;                        ///< share per unit, else counts
  std::vector<HistogramPanel> panels = {};
};

/// Error histograms, a panel a joint, series overlaid in common bins (common_bins.h), the mean of each marked
/// and mean, standard deviation and number of samples written above (UKF paper, figure 9).
class HistogramFigure : public PanelFigure {
  Q_OBJECT
 public:
  /// Series in the order of drawing, the last on top.
  explicit HistogramFigure(HistogramData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const HistogramData& data() const { return data_; }

  /// What a series came to; of a series without a sample n is 0 and the histogram has no bin.
  struct Result {
    stats::Histogram histogram;
    std::size_t n = 0, without_value = 0;
    double mean = 0.0, sigma = 0.0;  ///< of all finite samples, those outside the axes too; NaN where unknown
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
