#pragma once

#include "core/learning/evaluation/learning_curve.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

struct LearningCurveData {
  QString title = {}, note = {};
  learning::LearningCurve curve = {};
};

/// Error on held-out trajectories against the number of training states (GPR paper, figure 5): distance and
/// angle, mean and median, beside the error with the rigid offset alone.
class LearningCurveFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit LearningCurveFigure(LearningCurveData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const LearningCurveData& data() const { return data_; }

 protected:
  int columnsFor(QSize size) const override;
  void restyle() override;
  void laidOut() override;

 private:
  struct Curves {
    QCPGraph *mean, *median, *offset;
  };
  void build(bool angle);

  LearningCurveData data_;
  std::vector<Curves> curves_;
};

}  // namespace capstan::widgets
