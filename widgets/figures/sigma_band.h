#pragma once

#include <qcustomplot.h>

namespace capstan::widgets {

/// The area between two curves over one axis rect, behind the lines. On screen it is filled in short pieces,
/// because the time of Qt's polygon filler grows with the square of the number of crossings of the outline
/// with a row of pixels. In files it is one shape.
class SigmaBand : public QCPLayerable {
  Q_OBJECT
 public:
  explicit SigmaBand(QCPAxisRect* axes);

  void setColour(const QColor& colour) { colour_ = colour; }
  QColor colour() const { return colour_; }

  void begin() { points_.resize(0); }
  void add(double t, double low, double high) { points_.append({t, low, high}); }

  struct Point {
    double t, low, high;
  };
  const QVector<Point>& points() const { return points_; }

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
  void draw(QCPPainter* painter) override;

 private:
  void fillPiece(QCPPainter* painter, int first, int last) const;

  QCPAxisRect* axes_;
  QColor colour_;
  QVector<Point> points_;
};

}  // namespace capstan::widgets
