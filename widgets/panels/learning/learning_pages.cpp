#include "widgets/panels/learning/learning_pages.h"

#include <QShortcut>
#include <QTabBar>

#include "widgets/panels/learning/ablation_view.h"
#include "widgets/panels/learning/clouds_view.h"
#include "widgets/panels/learning/confidence_view.h"
#include "widgets/panels/learning/curve_view.h"
#include "widgets/panels/learning/errors_view.h"
#include "widgets/panels/learning/reliability_view.h"
#include "widgets/panels/learning/stages_view.h"
#include "widgets/panels/learning/trajectory_view.h"

namespace capstan::widgets {

LearningPages::LearningPages(QWidget* parent) : QTabWidget(parent) {
  setDocumentMode(true);
  tabBar()->setDrawBase(false);
  QFont small = tabBar()->font();  // eight of them side by side in a window of 1280 px
  small.setPointSizeF(0.9 * small.pointSizeF());
  tabBar()->setFont(small);
  const auto page = [this](QWidget* content, const QString& title, const QString& tip) {
    const int index = addTab(content, title);
    setTabToolTip(index, QStringLiteral("%1 (Alt+%2)").arg(tip).arg(index + 1));
    auto* shortcut = new QShortcut(QKeySequence(QStringLiteral("Alt+%1").arg(index + 1)), this);
    connect(shortcut, &QShortcut::activated, this, [this, index] { setCurrentIndex(index); });
  };
  page(stages_ = new StagesView, tr("Stages"), tr("Every stage with its numbers, and the lag"));
  page(clouds_ = new CloudsView, tr("3-D"), tr("Commanded, observed and corrected positions"));
  page(trajectories_ = new TrajectoryView, tr("Trajectories"),
       tr("Rejected states of each, and its poses over time"));
  page(errors_ = new ErrorsView, tr("Errors"), tr("Errors per degree of freedom on held-out trajectories"));
  page(ablation_ = new AblationView, tr("Ablation"), tr("Error with each part of the method"));
  page(curve_ = new CurveView, tr("Curve"), tr("Error against the number of training states"));
  page(confidence_ = new ConfidenceView, tr("Confidence"),
       tr("Confidence of the correction over the workspace"));
  page(reliability_ = new ReliabilityView, tr("Reliability"),
       tr("Reliability of the errors that the correction states"));
}

std::vector<LearningView*> LearningPages::views() const {
  return {stages_, clouds_, trajectories_, errors_, ablation_, curve_, confidence_, reliability_};
}

void LearningPages::setTheme(const Theme& theme) {
  for (LearningView* view : views()) view->setTheme(theme);
}

void LearningPages::showResults(const LearningResults& results) {
  for (LearningView* view : views()) view->showResults(results);
}

}  // namespace capstan::widgets
