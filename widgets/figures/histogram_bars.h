#pragma once

#include <qcustomplot.h>

#include <vector>

#include "widgets/figures/series_style.h"

namespace capstan::widgets {

/// One histogram in one axis rect: filled bars under one outline, so that overlaid histograms stay visible.
class HistogramBars : public QCPLayerable {
  Q_OBJECT
 public:
  explicit HistogramBars(QCPAxisRect* axes);

  /// Sets the bars in the axes' units. `edges` has one element more than `heights`.
  void setBars(std::vector<double> edges, std::vector<double> heights);
  /// Sets a vertical line over the whole height at `x`, the mean; NaN: none.
  void setMean(double x) { mean_ = x; }
  void setStyle(const SeriesStyle& style, double line);

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
  void draw(QCPPainter* painter) override;

 private:
  void drawMean(QCPPainter* painter) const;

  QCPAxisRect* axes_;
  std::vector<double> edges_, heights_;
  double mean_;
  SeriesStyle style_;
  double line_ = 1.0;
};

}  // namespace capstan::widgets
