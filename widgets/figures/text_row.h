#pragma once

#include <qcustomplot.h>

#include <vector>

namespace capstan::widgets {

/// Lines of text above a plot, wrapped to the given width. The height of the row is that of the wrapped
/// lines.
class TextRow : public QCPLayoutElement {
  Q_OBJECT
 public:
  struct Line {
    QString text;
    bool strong = false;  ///< bold in the text colour; false: muted colour
    bool beside = false;  ///< placed after the line before it, if both fit the width
  };

  explicit TextRow(QCustomPlot* plot);

  void setLines(std::vector<Line> lines) { lines_ = std::move(lines); }
  const std::vector<Line>& lines() const { return lines_; }
  void setColours(const QColor& strong, const QColor& quiet);
  /// Wraps the lines; a hidden row has no height. `strong_points`, `points`: font sizes [typographic points];
  /// `width` [px].
  void fit(double strong_points, double points, double width);
  /// Shows only strong lines and those beside them, to save room, until the next call.
  void setBrief(bool brief) { brief_ = brief; }
  /// Height that the wrapped lines need [px].
  int needed() const { return height_; }
  /// Box of each wrapped line, in pixels of the plot.
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

/// `text` wrapped at its spaces so that no line is wider than `width`, where possible; at non-breaking spaces
/// only where necessary.
QStringList wrapText(const QString& text, const QFont& font, double width);

}  // namespace capstan::widgets
