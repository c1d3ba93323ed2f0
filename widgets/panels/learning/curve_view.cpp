#include "widgets/panels/learning/curve_view.h"

#include <QBoxLayout>
#include <QPushButton>

#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/work/figure_sheet.h"

namespace capstan::widgets {

CurveView::CurveView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 6, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  run_ = new QPushButton(tr("Run the learning curve"));
  run_->setObjectName("run_curve");
  run_->setToolTip(tr("Train on 2.5, 5, 10, 25, 50 and 100 % of the states (F7)"));
  row->addWidget(run_);
  row->addStretch();
  column->addLayout(row);
  column->addWidget(sheet_ = new FigureSheet, 1);
  sheet_->setEmptyWords(
      tr("Number of states that is enough: corrections are trained on increasing numbers of states, and "
         "evaluated on the same held-out trajectories"));
  connect(run_, &QPushButton::clicked, this, &CurveView::runRequested);
}

void CurveView::setTheme(const Theme& theme) { sheet_->setTheme(theme); }

void CurveView::setReady(bool ready) { run_->setEnabled(ready); }

void CurveView::showResults(const LearningResults& results) {
  if (curve_ == results.curve) return;
  curve_ = results.curve;
  sheet_->setFigure(curve_ ? std::make_unique<LearningCurveFigure>(curveData(*curve_)) : nullptr);
}

}  // namespace capstan::widgets
