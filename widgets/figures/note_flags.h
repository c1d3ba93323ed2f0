#pragma once

#include <qcustomplot.h>

#include <optional>
#include <vector>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// A note of the session on the time axis.
struct NoteFlag {
  double t = 0.0;  ///< [s]
  QString text;
};

/// Notes as flags over one axis rect: a dotted line from the upper edge, with a pennant.
class NoteFlags : public QCPLayerable {
  Q_OBJECT
 public:
  /// `flags` must outlive the plot.
  NoteFlags(QCPAxisRect* axes, const std::vector<NoteFlag>& flags);

  void setTheme(const Theme& theme) { ink_ = theme.accent; }
  /// The flag within a few pixels of `x` [px], if any.
  const NoteFlag* at(double x) const;

 protected:
  QRect clipRect() const override { return axes_->rect(); }
  void applyDefaultAntialiasingHint(QCPPainter* painter) const override { painter->setAntialiasing(true); }
  void draw(QCPPainter* painter) override;

 private:
  QCPAxisRect* axes_;
  const std::vector<NoteFlag>& flags_;
  QColor ink_;
};

}  // namespace capstan::widgets
