#pragma once

#include <qcustomplot.h>

#include "widgets/figures/joint_history.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// A line over one axis rect at the time at which the history's full detail begins, with words at its foot.
/// Left of it the lowest and highest values of blocks are drawn, right of it every sample.
class DetailMark : public QCPLayerable {
  Q_OBJECT
 public:
  /// `history` must outlive the plot. `words`: false draws the line alone.
  DetailMark(QCPAxisRect* axes, const JointHistory& history, bool words);

  void setTheme(const Theme& theme);
  /// Sets another history, which must outlive the plot.
  void setHistory(const JointHistory& history) { history_ = &history; }
  /// Words beside the line for the present time range; empty where the whole range is in full detail.
  QString text() const;
  /// Where the last draw placed the words; null: no words.
  QRectF box() const { return box_; }

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(false); }
  void draw(QCPPainter* painter) override;

 private:
  QRectF drawWords(QCPPainter* painter, const QString& words, double left) const;

  QCPAxisRect* axes_;
  const JointHistory* history_;
  bool words_;
  QColor ink_, ground_;
  QRectF box_;
};

}  // namespace capstan::widgets
