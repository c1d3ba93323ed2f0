#pragma once

#include <qcustomplot.h>

#include <array>
#include <optional>
#include <vector>

#include "widgets/figures/header_layout.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// A row above a plot: a title at the left, then one column per quantity. The rows of one figure share their
/// columns. The legend row writes each quantity's name beside its line; a value row writes its number, and a
/// summary row too, with a quiet title; a note is a title alone. A hidden row has no height.
class FigureHeader : public QCPLayoutElement {
  Q_OBJECT
 public:
  enum class Role { kLegend, kValues, kSummary, kNote };
  static constexpr int kLeftMargin = 8, kRightMargin = 16;  ///< also of the axes [px]

  FigureHeader(QCustomPlot* plot, Role role);

  void setTheme(const Theme& theme) { theme_ = &theme; }
  void setLayout(const HeaderLayout& layout, const HeaderPoints& points);
  void setTitle(const QString& title) { title_ = title; }
  QString title() const { return title_; }
  /// Writes the title in the colour of faults, for a title that reports one.
  void setFault(bool fault) { fault_ = fault; }
  /// Width of a title in this row's font at `points` [px].
  double titleWidth(const QString& title, const HeaderPoints& points) const;
  double textWidth(const QString& title) const { return titleWidth(title, points_); }
  /// Sets the number of a column of a value row. Numbers are right-aligned, so that decimal points line up.
  void setValue(Quantity quantity, const QString& text) { texts_[static_cast<std::size_t>(quantity)] = text; }
  QString value(Quantity quantity) const { return texts_[static_cast<std::size_t>(quantity)]; }
  void setSigma(const QString& text) { texts_[HeaderLayout::kSigma] = text; }
  QString sigma() const { return texts_[HeaderLayout::kSigma]; }

  /// Draws a legend's entry as that of a hidden curve.
  void setMuted(Quantity quantity, bool muted) { muted_[static_cast<std::size_t>(quantity)] = muted; }
  /// The legend's entry at a position [px], if any.
  std::optional<Quantity> entryAt(const QPointF& position) const;

  /// A text and its box in pixels of the figure; the box of a legend's text includes its line.
  struct Text {
    QString text;
    QRectF box;
  };
  std::vector<Text> texts() const;

 protected:
  QSize minimumOuterSizeHint() const override { return {200, lines() * lineHeight()}; }
  QSize maximumOuterSizeHint() const override { return {QWIDGETSIZE_MAX, lines() * lineHeight()}; }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
  void draw(QCPPainter* painter) override;

 private:
  int lines() const { return !visible() ? 0 : role_ == Role::kNote ? 1 : layout_.lines; }
  /// Whether a column belongs to a hidden curve; the band belongs to the UKF.
  bool isMuted(std::size_t column) const {
    return muted_[column == HeaderLayout::kSigma ? static_cast<std::size_t>(Quantity::kUkf) : column];
  }
  int lineHeight() const;
  QFont titleFont(const HeaderPoints& points) const;
  QFont columnFont() const;
  QRectF titleBox() const;
  QRectF columnBox(std::size_t column) const;
  QRectF sampleBox(std::size_t column) const;
  void drawSample(QCPPainter* painter, std::size_t column, const QRectF& box) const;

  Role role_;
  const Theme* theme_;
  HeaderLayout layout_;
  HeaderPoints points_;
  QString title_;
  bool fault_ = false;
  std::array<QString, HeaderLayout::kColumns> texts_;
  std::array<bool, HeaderLayout::kSigma> muted_{};
};

}  // namespace capstan::widgets
