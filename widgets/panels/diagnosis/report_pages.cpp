#include "widgets/panels/diagnosis/report_pages.h"

#include <QShortcut>
#include <QTabBar>

#include "widgets/panels/diagnosis/gain_table.h"
#include "widgets/panels/diagnosis/posterior_table.h"
#include "widgets/panels/diagnosis/ranking_table.h"
#include "widgets/panels/diagnosis/refit_table.h"
#include "widgets/panels/diagnosis/signature_view.h"
#include "widgets/panels/diagnosis/time_view.h"

namespace capstan::widgets {

ReportPages::ReportPages(QWidget* parent) : QTabWidget(parent) {
  setDocumentMode(true);
  tabBar()->setDrawBase(false);
  const auto page = [this](QWidget* content, const QString& title, const QString& tip) {
    const int index = addTab(content, title);
    setTabToolTip(index, QStringLiteral("%1 (Alt+%2)").arg(tip).arg(index + 1));
    auto* shortcut = new QShortcut(QKeySequence(QStringLiteral("Alt+%1").arg(index + 1)), this);
    connect(shortcut, &QShortcut::activated, this, [this, index] { setCurrentIndex(index); });
  };
  page(signatures_ = new SignatureView, tr("Signatures"), tr("What the residual depends on"));
  page(history_ = new TimeView, tr("Over time"), tr("Measured, simulated, and residual, over time"));
  page(ranking_ = new RankingTable, tr("Ranking"),
       tr("Every candidate of the search: its trial fit, and its probability in the end"));
  page(refit_ = new RefitTable, tr("Refit"),
       tr("Parameters of the robot changed by the refit, without and with the effects"));
  page(gain_ = new GainTable, tr("Gain"),
       tr("RMS of the residual on held-out data before and after the model is extended"));
  page(posterior_ = new PosteriorTable, tr("Posterior"), tr("Probability of each set of effects"));
  connect(ranking_, &RankingTable::chosenChanged, this, &ReportPages::candidateChosen);
}

void ReportPages::setTheme(const Theme& theme) {
  signatures_->setTheme(theme);
  history_->setTheme(theme);
  ranking_->setTheme(theme);
  refit_->setTheme(theme);
  gain_->setTheme(theme);
  posterior_->setTheme(theme);
}

void ReportPages::showReport(const std::shared_ptr<const diagnosis::Report>& report) {
  signatures_->showReport(report);
  history_->showReport(report);
  ranking_->showReport(*report);
  refit_->showReport(*report);
  gain_->showReport(*report);
  posterior_->showReport(*report);
}

void ReportPages::showChannel(const std::string& name) {
  signatures_->showChannel(name);
  history_->showChannel(name);
}

}  // namespace capstan::widgets
