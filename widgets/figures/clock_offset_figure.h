#pragma once

#include "core/learning/poses/states.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/sigma_band.h"

namespace capstan::widgets {

struct ClockOffsetData {
  QString title = {}, note = {};
  learning::ClockOffsetReport clock_offset = {};
};

/// Misfit between the speeds of two streams against the offset between their clocks. A line marks the offset
/// of smallest misfit, a band its ± 2 σ.
class ClockOffsetFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit ClockOffsetFigure(ClockOffsetData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const ClockOffsetData& data() const { return data_; }

 protected:
  int columnsFor(QSize) const override { return 1; }
  void restyle() override;

 private:
  ClockOffsetData data_;
  QCPGraph* misfit_;
  QCPItemLine* lag_;
  SigmaBand* sigma_;
};

}  // namespace capstan::widgets
