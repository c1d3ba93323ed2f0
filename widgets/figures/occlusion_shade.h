#pragma once

#include <qcustomplot.h>

#include <optional>
#include <vector>

#include "widgets/figures/joint_history.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Shades occluded time behind the curves of one axis rect. The word "occluded" is written at the upper or
/// lower edge of a shade where no curve passes.
class OcclusionShade : public QCPLayerable {
  Q_OBJECT
 public:
  /// `history` must outlive the plot. `joint`: the joint whose curves the axes show; only the shades of the
  /// first joint have the word.
  OcclusionShade(QCPAxisRect* axes, const JointHistory& history, int joint);

  void setTheme(const Theme& theme);
  /// Sets another history, which must outlive the plot.
  void setHistory(const JointHistory& history) { history_ = &history; }
  /// Number of shades drawn by the last draw.
  int drawn() const { return drawn_; }
  /// Rectangles of the words, by the last draw.
  const std::vector<QRectF>& labels() const { return labels_; }

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
  void draw(QCPPainter* painter) override;

 private:
  void drawBox(QCPPainter* painter, const QRectF& box);
  std::optional<QRectF> placeFor(const QSizeF& word, const QRectF& box) const;
  /// Range of all values drawn in [begin, end] [s]; empty: none.
  std::optional<QCPRange> valuesWithin(double begin, double end) const;

  QCPAxisRect* axes_;
  const JointHistory* history_;
  std::size_t joint_;
  QColor shade_, ink_;
  int drawn_ = 0;
  std::vector<QRectF> labels_;
};

}  // namespace capstan::widgets
