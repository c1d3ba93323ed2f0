#pragma once

#include <vector>

#include "widgets/figures/panel_figure.h"

/// Normalised innovation squared of the camera measurements over time: the data of the figure.
struct NisData {
  QString title, note;
  std::vector<double> t, nis;  ///< time [s]; NIS / 3, mean 1 for a consistent filter
};

/// Figure of the NIS. PanelFigure provides themes, paper sizes and export.
class NisFigure : public capstan::widgets::PanelFigure {
 public:
  explicit NisFigure(NisData data);

  std::unique_ptr<capstan::widgets::Figure> copy() const override;
  std::vector<capstan::widgets::FigureNumbers> numbers() const override;

 protected:
  int columnsFor(QSize) const override { return 1; }
  void restyle() override;

 private:
  NisData data_;
  QCPGraph* dots_;
  QCPGraph* expected_;
};
