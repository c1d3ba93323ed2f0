#include "widgets/panels/learning/errors_view.h"

#include <QBoxLayout>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QShortcut>

#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/work/figure_sheet.h"

namespace capstan::widgets {

ErrorsView::ErrorsView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 6, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  words_ = new QLabel;
  words_->setWordWrap(true);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  words_->setAccessibleName(tr("errors in words"));
  which_ = new QComboBox;
  which_->setObjectName("error_states");
  which_->addItem(tr("states accepted by cleaning"));
  which_->addItem(tr("all held-out states"));
  which_->setToolTip(tr("With or without observations that cleaning rejects"));
  observed_ = new QCheckBox(tr("observed"));
  observed_->setObjectName("error_observed");
  observed_->setChecked(true);
  observed_->setToolTip(tr("Show errors without any correction too, on a larger scale (Alt+S)"));
  row->addWidget(words_, 1);
  row->addWidget(observed_, 0, Qt::AlignTop);
  row->addWidget(which_, 0, Qt::AlignTop);
  column->addLayout(row);
  column->addWidget(sheet_ = new FigureSheet, 1);
  sheet_->setEmptyWords(
      tr("Errors on held-out trajectories, once a correction is trained: press Train (F5)"));
  connect(which_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &ErrorsView::draw);
  connect(observed_, &QCheckBox::toggled, this, &ErrorsView::draw);
  connect(new QShortcut(QKeySequence(QStringLiteral("Alt+S")), this), &QShortcut::activated, observed_,
          &QCheckBox::toggle);
  which_->setVisible(false);
  observed_->setVisible(false);
}

void ErrorsView::setTheme(const Theme& theme) { sheet_->setTheme(theme); }

void ErrorsView::showResults(const LearningResults& results) {
  if (evaluation_ == results.evaluation) return;
  evaluation_ = results.evaluation;
  draw();
}

void ErrorsView::draw() {
  which_->setVisible(evaluation_ != nullptr);
  observed_->setVisible(evaluation_ != nullptr);
  words_->clear();
  if (!evaluation_) return sheet_->setFigure(nullptr);
  const bool clean = which_->currentIndex() == 0;
  if (!clean)
    words_->setText(
        tr("Medians, observed → rigid offset → corrected: %1.").arg(errorWords(*evaluation_, clean)));
  sheet_->setFigure(std::make_unique<BoxplotFigure>(errorData(*evaluation_, clean, observed_->isChecked())));
}

QString ErrorsView::words() const { return words_->text(); }

}  // namespace capstan::widgets
