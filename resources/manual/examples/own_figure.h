#pragma once

#include <vector>

#include "widgets/figures/panel_figure.h"

/// Normalised innovation squared of the camera measurements over time. Plain data, given once.
struct NisData {
  QString title, note;
  std::vector<double> t, nis;  ///< [s]; over 3 degrees of freedom, 1 for a consistent filter
};

/// A figure like Capstan's own: themes, paper sizes, export and numbers come with PanelFigure.
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
