#pragma once

#include "core/learning/evaluation/stated_errors.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

struct ReliabilityData {
  QString title = {}, note = {};
  learning::StatedErrors stated = {};
};

/// Reliability diagram: share of errors within their stated interval against the stated probability of that
/// interval. The curve lies on the diagonal where the stated σ are right, below it where they are too small.
/// Position and rotation, one curve per degree of freedom.
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
  std::vector<QCPGraph*> curves_;     ///< one curve per degree of freedom
  std::vector<QCPGraph*> diagonals_;  ///< one diagonal per panel
};

}  // namespace capstan::widgets
