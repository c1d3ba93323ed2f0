#include "widgets/shell/learning_controller.h"

#include <QAction>
#include <QStackedWidget>

#include "widgets/panels/learning/learning_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/dock_scroll.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

LearningController::LearningController(LearningPanel& panel, QStackedWidget& centre, SessionLink& link,
                                       SessionBar& bar, NotesPanel& notes, QObject* parent)
    : QObject(parent) {
  addAction(panel, centre, bar);
  connect(&link, &SessionLink::opened, this, [this](const tracking::SourceInfo& info) { now_ = info.begin; });
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) { now_ = status.t; });
  connect(&panel, &LearningPanel::exported, this,
          [this, &notes](const QString& folder) { notes.addFile(now_, "export", folder); });
  connect(&panel, &LearningPanel::modelSaved, this,
          [this, &notes](const QString& path) { notes.addFile(now_, "correction", path); });
}

void LearningController::addAction(LearningPanel& panel, QStackedWidget& centre, SessionBar& bar) {
  auto* action = new QAction(tr("Learn"), this);
  action->setObjectName("learn");
  action->setCheckable(true);
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+Shift+L")));
  action->setToolTip(
      tr("Learn a correction of commands from recorded tip poses, instead of the plots, or the plots again "
         "(Ctrl+Shift+L)"));
  bar.addPanelAction(action);
  connect(action, &QAction::toggled, &centre, [&panel, &centre](bool shown) {
    centre.setCurrentIndex(shown ? pageWith(centre, panel) : 0);
    if (shown) panel.setFocus();
  });
}

}  // namespace capstan::widgets
