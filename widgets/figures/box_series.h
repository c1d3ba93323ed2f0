#pragma once

#include <qcustomplot.h>

#include <vector>

#include "core/stats/boxplot.h"
#include "widgets/figures/series_style.h"

namespace capstan::widgets {

/// Draws Tukey boxes in one axis rect: box, median with its number at the top of the axes, whiskers,
/// outliers. An arrow at the edge of the axes gives the number of outliers beyond the value axis.
class BoxSeries : public QCPLayerable {
  Q_OBJECT
 public:
  struct Box {
    double x = 0.0, half_width = 0.3;  ///< centre and half width on the bottom axis
    stats::Boxplot statistics;         ///< n = 0: the box is not drawn
    std::vector<double> outliers;      ///< those of statistics.outliers that are drawn
  };

  explicit BoxSeries(QCPAxisRect* axes);

  void setBoxes(std::vector<Box> boxes) { boxes_ = std::move(boxes); }
  /// Sets colours and line width. `points`: font size of the numbers [typographic points].
  void setStyle(const SeriesStyle& style, const QColor& text, double line, double points);
  /// Sets the visible range of values. Outliers outside it are counted, not drawn.
  void setSeen(const QCPRange& values) { seen_ = values; }
  /// Writes the numbers upright, for boxes that are narrower than their numbers.
  void setUpright(bool upright) { upright_ = upright; }
  double widestNumber() const;  ///< width of the widest number [px]
  double numberHeight() const;  ///< height of a number [px]
  /// Height that the numbers, and counts of outliers above the axis, take at the top of the axes [px].
  double headroom() const;
  double footroom() const;  ///< height for counts of outliers below the axis [px]

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
  void draw(QCPPainter* painter) override;

 private:
  void drawBox(QCPPainter* painter, const Box& box) const;
  void drawOutliers(QCPPainter* painter, const Box& box) const;
  int above(const Box& box) const;
  int below(const Box& box) const;
  double stripHeight() const;
  QString numberOf(const Box& box) const;
  void drawNumber(QCPPainter* painter, const Box& box) const;
  void drawBeyond(QCPPainter* painter, double x, double y, int direction, int count) const;

  QCPAxisRect* axes_;
  std::vector<Box> boxes_;
  SeriesStyle style_;
  QColor text_;
  double line_ = 1.0, points_ = 7.0;
  bool upright_ = false;
  QCPRange seen_;
};

}  // namespace capstan::widgets
