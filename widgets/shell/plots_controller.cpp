#include "widgets/shell/plots_controller.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QMenu>

#include "widgets/figures/joint_errors.h"
#include "widgets/figures/save_figure.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

PlotsController::PlotsController(JointFigure& figure, SessionLink& link, NotesPanel& notes, SessionBar& bar,
                                 QObject* parent)
    : QObject(parent), figure_(figure), bar_(bar) {
  figure.setErrors(errors_);
  connect(&link, &SessionLink::opened, this, [this] {
    errors_.clear();
    flags_.clear();
    figure_.setFlags({});
    figure_.setMark(std::nullopt);
  });
  connect(&link, &SessionLink::history, this, [this](const std::vector<tracking::Snapshot>& snapshots) {
    for (const auto& snapshot : snapshots) appendErrors(errors_, snapshot);
  });
  connect(&notes, &NotesPanel::eventAdded, this, &PlotsController::addFlag);
  connect(&figure, &JointFigure::menuAboutToShow, this, &PlotsController::fillMenu);
}

void PlotsController::addFlag(double t, const QString& kind, const QString& text) {
  if (kind != QLatin1String("note")) return;
  flags_.push_back({t, text});
  figure_.setFlags(flags_);
}

void PlotsController::fillMenu(QMenu* menu) {
  addToggle(menu, tr("Errors in place of positions\tD"), figure_.errorsShown(), &JointFigure::showErrors);
  addToggle(menu, tr("Statistics of the visible range\tS"), figure_.statisticsShown(),
            &JointFigure::showStatistics);
  menu->addAction(figure_.mark() ? tr("Remove the mark\tM") : tr("Mark at the cursor\tM"), &figure_,
                  [this, t = figure_.cursorTime()] { figure_.setMark(figure_.mark() ? std::nullopt : t); });
  menu->addAction(tr("Show all curves"), &figure_, &JointFigure::showAll);
  menu->addSeparator();
  menu->addAction(tr("Copy picture"), this, &PlotsController::copyPicture);
  menu->addAction(tr("Copy numbers"), this, &PlotsController::copyNumbers);
  menu->addAction(tr("Export this range…"), &bar_, &SessionBar::exportRequested);
}

QAction* PlotsController::addToggle(QMenu* menu, const QString& text, bool on,
                                    void (JointFigure::*set)(bool)) {
  QAction* action = menu->addAction(text);
  action->setCheckable(true);
  action->setChecked(on);
  connect(action, &QAction::toggled, &figure_, set);
  return action;
}

void PlotsController::copyPicture() { QApplication::clipboard()->setPixmap(figure_.grab()); }

void PlotsController::copyNumbers() {
  const QCPRange range = figure_.timeRange();
  QString text = QString::fromStdString(jointTable(figure_.history(), range.lower, range.upper));
  QApplication::clipboard()->setText(text.replace(QLatin1Char(','), QLatin1Char('\t')));
}

}  // namespace capstan::widgets
