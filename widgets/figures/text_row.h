#pragma once

#include <qcustomplot.h>

#include <vector>

namespace capstan::widgets {

/// Lines of text above a plot, wrapped to the width given. Its height is that of the wrapped lines.
class TextRow : public QCPLayoutElement {
  Q_OBJECT
 public:
  struct Line {
    QString text;
    bool strong = false;  ///< bold, in the text colour; else in the muted one
    bool beside = false;  ///< behind the line before it, where both fit the width
  };

  explicit TextRow(QCustomPlot* plot);

  void setLines(std::vector<Line> lines) { lines_ = std::move(lines); }
  const std::vector<Line>& lines() const { return lines_; }
  void setColours(const QColor& strong, const QColor& quiet);
  /// Hidden, it takes no room. `strong_points` and `points`: font sizes [typographic points]; `width` [px].
  void fit(double strong_points, double points, double width);
  /// Strong lines only and those beside them, where there is no room for the others; until the next call.
  void setBrief(bool brief) { brief_ = brief; }
  /// Height that the wrapped lines need [px].
  int needed() const { return height_; }
  /// Where each wrapped line is written, in pixels of the plot.
  std::vector<QRectF> boxes() const;

 protected:
  QSize minimumOuterSizeHint() const override { return {10, height_}; }
  QSize maximumOuterSizeHint() const override { return {QWIDGETSIZE_MAX, height_}; }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
  void draw(QCPPainter* painter) override;

 private:
  QFont fontOf(const Line& line) const;
  double widthOf(const Line& line) const;

  std::vector<Line> lines_, wrapped_;
  QColor strong_, quiet_;
  double strong_points_ = 9.0, points_ = 8.0;
  int height_ = 0;
  bool brief_ = false;
};

/// `text` cut at its spaces so that no line is wider than `width` where a cut can help; at unbreakable ones
/// only where nothing else helps.
QStringList wrapText(const QString& text, const QFont& font, double width);

}  // namespace capstan::widgets
