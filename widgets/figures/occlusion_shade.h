#pragma once

#include <qcustomplot.h>

#include "widgets/figures/joint_history.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Shades occluded time behind the curves of one axis rect, with the word where there is room.
class OcclusionShade : public QCPLayerable {
  Q_OBJECT
 public:
  /// `history` must outlive the plot. `labelled`: write "occluded" into the shade.
  OcclusionShade(QCPAxisRect* axes, const JointHistory& history, bool labelled);

  void setTheme(const Theme& theme);
  /// Shades drawn by the last draw.
  int drawn() const { return drawn_; }

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
  void draw(QCPPainter* painter) override;

 private:
  QCPAxisRect* axes_;
  const JointHistory& history_;
  bool labelled_;
  QColor shade_, ink_;
  int drawn_ = 0;
};

}  // namespace capstan::widgets
