#include "widgets/shell/analysis_pages.h"

#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/experiments/experiments_panel.h"

namespace capstan::widgets {

AnalysisPages::AnalysisPages(QWidget* parent)
    : QTabWidget(parent), errors_(new AnalysisPanel), experiments_(new ExperimentsPanel) {
  setObjectName("analysis_pages");
  setDocumentMode(true);
  addTab(errors_, tr("Errors of runs"));
  addTab(experiments_, tr("Experiments E to H"));
  setTabToolTip(0, tr("Histogram, box plot and comparison of one or two runs"));
  setTabToolTip(1,
                tr("The GPR paper's experiments on your tables or on a simulated arm, beside its numbers"));
}

void AnalysisPages::setTheme(const Theme& theme) {
  errors_->setTheme(theme);
  experiments_->setTheme(theme);
}

void AnalysisPages::save(QSettings& settings) const {
  errors_->save(settings);
  experiments_->save(settings);
}

void AnalysisPages::restore(const QSettings& settings) {
  errors_->restore(settings);
  experiments_->restore(settings);
}

}  // namespace capstan::widgets
