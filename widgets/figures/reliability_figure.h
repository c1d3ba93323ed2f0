#pragma once

#include "core/learning/evaluation/stated_errors.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

struct ReliabilityData {
  QString title = {}, note = {};
  learning::StatedErrors stated = {};
};

/// Share of the errors that are within the interval stated for them, against the share that the interval is
/// stated for: on the diagonal where the stated σ are right, below it where the correction is surer than it
/// may be. Position and rotation, a curve a degree of freedom.
class ReliabilityFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit ReliabilityFigure(ReliabilityData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const ReliabilityData& data() const { return data_; }

 protected:
  int columnsFor(QSize size) const override;
  void restyle() override;

 private:
  void build(bool rotation);

  ReliabilityData data_;
  std::vector<QCPGraph*> curves_;     ///< by degree of freedom
  std::vector<QCPGraph*> diagonals_;  ///< by panel
};

}  // namespace capstan::widgets
