#pragma once

#include <qcustomplot.h>

#include <array>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// A row above a plot: a title at the left, then one column a quantity, which rows of one figure share. The
/// legend row writes each quantity's name beside its line; a value row writes its number.
class FigureHeader : public QCPLayoutElement {
  Q_OBJECT
 public:
  enum class Role { kLegend, kValues };
  static constexpr int kColumns = 4;

  FigureHeader(QCustomPlot* plot, Role role);

  void setTheme(const Theme& theme);
  void setPoints(double text_points, double number_points);
  void setTitle(const QString& title) { title_ = title; }
  QString title() const { return title_; }
  /// Text of a column; numbers are right-aligned, so equal decimals stand below each other.
  void setValue(Quantity quantity, const QString& text) { values_[index(quantity)] = text; }
  QString value(Quantity quantity) const { return values_[index(quantity)]; }

 protected:
  QSize minimumOuterSizeHint() const override { return {200, height()}; }
  QSize maximumOuterSizeHint() const override { return {QWIDGETSIZE_MAX, height()}; }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
  void draw(QCPPainter* painter) override;

 private:
  static std::size_t index(Quantity quantity) { return static_cast<std::size_t>(quantity); }
  int height() const;
  void drawSample(QCPPainter* painter, Quantity quantity, const QRectF& box) const;

  Role role_;
  const Theme* theme_;
  double text_points_ = 11.0, number_points_ = 12.0;
  QString title_;
  std::array<QString, kColumns> values_;
};

}  // namespace capstan::widgets
