#pragma once

#include <QStringList>
#include <QWidget>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Numbered steps in a row: the current one is highlighted, finished ones have a tick.
class StepBar : public QWidget {
  Q_OBJECT

 public:
  explicit StepBar(QStringList steps, QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Sets the current step; those before it are finished. `step` beyond the last: all are finished.
  void setStep(int step);
  int step() const { return step_; }
  QSize sizeHint() const override { return {360, 34}; }
  QSize minimumSizeHint() const override { return {240, 34}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QStringList steps_;
  Theme theme_ = Theme::dark();
  int step_ = 0;
};

}  // namespace capstan::widgets
