#pragma once

#include <qcustomplot.h>

#include <functional>
#include <vector>

namespace capstan::widgets {

/// One entry: a word, and the function that draws its sample into a box.
struct LegendEntry {
  QString text;
  std::function<void(QCPPainter*, const QRectF&)> draw;
};

/// Legend entries side by side above the panels of a figure, on as many lines as the width requires.
class FigureLegend : public QCPLayoutElement {
  Q_OBJECT
 public:
  explicit FigureLegend(QCustomPlot* plot);

  void setEntries(std::vector<LegendEntry> entries) { entries_ = std::move(entries); }
  const std::vector<LegendEntry>& entries() const { return entries_; }
  void setColour(const QColor& text) { text_ = text; }
  /// Arranges the entries. `points`: font size [typographic points]; `width` [px].
  void fit(double points, double width);
  /// Height that the entries need [px].
  int needed() const { return height_; }
  /// Box of each entry, sample and word, in pixels of the plot.
  std::vector<QRectF> boxes() const;

 protected:
  QSize minimumOuterSizeHint() const override { return {10, height_}; }
  QSize maximumOuterSizeHint() const override { return {QWIDGETSIZE_MAX, height_}; }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
  void draw(QCPPainter* painter) override;

 private:
  std::vector<LegendEntry> entries_;
  std::vector<QRectF> places_;  ///< boxes of the entries within the element
  QColor text_;
  double points_ = 8.0;
  int height_ = 0;
};

}  // namespace capstan::widgets
