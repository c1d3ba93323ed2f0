#pragma once

#include <qcustomplot.h>

#include <vector>

#include "core/stats/boxplot.h"
#include "widgets/figures/series_style.h"

namespace capstan::widgets {

/// Tukey boxes in one axis rect: box, median with its number at the top of the axes, whiskers, outliers. What
/// lies beyond the value axis is counted at its edge.
class BoxSeries : public QCPLayerable {
  Q_OBJECT
 public:
  struct Box {
    double x = 0.0, half_width = 0.3;  ///< on the bottom axis
    stats::Boxplot statistics;         ///< n = 0: nothing is drawn
    std::vector<double> outliers;      ///< to be drawn, of statistics.outliers
  };

  explicit BoxSeries(QCPAxisRect* axes);

  void setBoxes(std::vector<Box> boxes) { boxes_ = std::move(boxes); }
  /// `points`: size of the numbers [typographic points].
  void setStyle(const SeriesStyle& style, const QColor& text, double line, double points);
  /// Only what lies within is drawn; outliers outside are counted.
  void setSeen(const QCPRange& values) { seen_ = values; }
  /// Numbers stand upright where the narrowest of all series' boxes has no room for them.
  void setUpright(bool upright) { upright_ = upright; }
  double widestNumber() const;  ///< [px]
  double numberHeight() const;  ///< [px]
  /// Room that numbers, and counts of what lies above, take at the top of the axes [px].
  double headroom() const;
  double footroom() const;  ///< and counts of what lies below, at the bottom [px]

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
