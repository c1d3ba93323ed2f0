#pragma once

#include <QWidget>

#include "core/identification/convergence.h"
#include "widgets/figures/theme.h"

class QCPGraph;
class QCPItemStraightLine;
class QCustomPlot;

namespace capstan::widgets {

/// One parameter over the time of the recording: value, its ±2σ, and its initial value as a dashed line.
class TracePlot : public QWidget {
  Q_OBJECT

 public:
  explicit TracePlot(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showTrace(const identification::Trace& trace, const identification::ParameterSet& set, int parameter);
  void clear();
  int points() const;
  QCustomPlot& plot() { return *plot_; }
  QSize minimumSizeHint() const override { return {200, 0}; }
  QSize sizeHint() const override { return {260, 110}; }

 private:
  QCustomPlot* plot_;
  QCPGraph *low_, *high_, *value_;
  QCPItemStraightLine* nominal_;
};

}  // namespace capstan::widgets
