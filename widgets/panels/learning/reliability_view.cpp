#include "widgets/panels/learning/reliability_view.h"

#include <QBoxLayout>

#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/work/figure_sheet.h"

namespace capstan::widgets {

ReliabilityView::ReliabilityView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 6, 0, 0);
  column->addWidget(sheet_ = new FigureSheet, 1);
  sheet_->setEmptyWords(
      tr("Reliability of the stated errors, once a correction is trained: press Train (F5)"));
}

void ReliabilityView::setTheme(const Theme& theme) { sheet_->setTheme(theme); }

void ReliabilityView::showResults(const LearningResults& results) {
  if (evaluation_ == results.evaluation) return;
  evaluation_ = results.evaluation;
  if (evaluation_)
    sheet_->setFigure(std::make_unique<ReliabilityFigure>(reliabilityData(*evaluation_)));
  else
    sheet_->setFigure(nullptr);
}

}  // namespace capstan::widgets
