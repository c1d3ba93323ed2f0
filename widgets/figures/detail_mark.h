#pragma once

#include <qcustomplot.h>

#include "widgets/figures/joint_history.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// A line over one axis rect where the history's full detail begins, with words at its foot: before it the
/// lowest and highest values of blocks are drawn, after it every sample.
class DetailMark : public QCPLayerable {
  Q_OBJECT
 public:
  /// `history` must outlive the plot. `words`: false draws the line alone.
  DetailMark(QCPAxisRect* axes, const JointHistory& history, bool words);

  void setTheme(const Theme& theme);
  /// What stands left of the line at the present time range; empty: all that is in range is in full detail.
  QString text() const;
  /// Where the words stand by the last draw; null: there are none.
  QRectF box() const { return box_; }

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
  void draw(QCPPainter* painter) override;

 private:
  QRectF drawWords(QCPPainter* painter, const QString& words, double left) const;

  QCPAxisRect* axes_;
  const JointHistory& history_;
  bool words_;
  QColor ink_, ground_;
  QRectF box_;
};

}  // namespace capstan::widgets
