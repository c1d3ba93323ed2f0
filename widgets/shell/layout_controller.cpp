#include "widgets/shell/layout_controller.h"

#include <QDockWidget>
#include <QEvent>
#include <QInputDialog>
#include <QMainWindow>
#include <QSettings>

#include "widgets/shell/dock_layout.h"
#include "widgets/shell/settings_undo.h"

namespace capstan::widgets {

namespace {

constexpr int kVersion = 3;  ///< of the set of docks; a state of another version is not restored
constexpr const char* kLast = "layout";
constexpr const char* kNamed = "layouts";  ///< map from name to state

}  // namespace

LayoutController::LayoutController(QMainWindow& window, QSettings& settings, SettingsUndo& undo)
    : QMenu(tr("La&yout"), &window),
      window_(window),
      settings_(settings),
      undo_(undo),
      first_(window.saveState(kVersion)),
      delete_(new QMenu(tr("Delete"), this)),
      save_(new QAction(tr("Save the layout as…"), &window)),
      reset_(new QAction(tr("Reset the layout"), &window)) {
  save_->setObjectName("layoutSave");
  reset_->setObjectName("layoutReset");
  connect(save_, &QAction::triggered, this, &LayoutController::askName);
  connect(reset_, &QAction::triggered, this, &LayoutController::reset);
  for (auto* dock : window.findChildren<QDockWidget*>())
    if (dock->allowedAreas() != Qt::NoDockWidgetArea) dock->installEventFilter(this);
  fill();
}

bool LayoutController::eventFilter(QObject* watched, QEvent* event) {
  auto* dock = qobject_cast<QDockWidget*>(watched);
  if (dock && event->type() == QEvent::Close) {
    const QByteArray before = window_.saveState(kVersion);
    undo_.changed(
        tr("closing of %1").arg(dock->windowTitle()),
        [this, before] { window_.restoreState(before, kVersion); }, [dock] { dock->close(); });
  }
  return QMenu::eventFilter(watched, event);
}

bool LayoutController::restoreLast() {
  return window_.restoreState(settings_.value(kLast).toByteArray(), kVersion);
}

void LayoutController::saveLast() { settings_.setValue(kLast, window_.saveState(kVersion)); }

QStringList LayoutController::names() const { return settings_.value(kNamed).toMap().keys(); }

void LayoutController::store(const QString& name) {
  QVariantMap all = settings_.value(kNamed).toMap();
  all[name] = window_.saveState(kVersion);
  settings_.setValue(kNamed, all);
  fill();
}

void LayoutController::remove(const QString& name) {
  QVariantMap all = settings_.value(kNamed).toMap();
  all.remove(name);
  settings_.setValue(kNamed, all);
  fill();
}

void LayoutController::choose(const QString& name) {
  const QByteArray state = settings_.value(kNamed).toMap().value(name).toByteArray();
  arrange(tr("layout %1").arg(name), [this, state] { window_.restoreState(state, kVersion); });
}

void LayoutController::reset() {
  arrange(tr("reset of the layout"), [this] {
    window_.restoreState(first_, kVersion);
    layOutDocks(window_);
  });
}

/// Arranges the docks by `act`; undo returns to the layout before it.
void LayoutController::arrange(const QString& what, const std::function<void()>& act) {
  const QByteArray before = window_.saveState(kVersion);
  act();
  undo_.changed(
      what, [this, before] { window_.restoreState(before, kVersion); }, act);
}

void LayoutController::fill() {
  clear();
  delete_->clear();
  for (const QString& name : names()) {
    const QString shown = QString(name).replace('&', "&&");
    connect(addAction(shown), &QAction::triggered, this, [this, name] { choose(name); });
    connect(delete_->addAction(shown), &QAction::triggered, this, [this, name] { remove(name); });
  }
  addSeparator();
  addAction(save_);
  delete_->setEnabled(!delete_->isEmpty());
  addMenu(delete_);
  addAction(reset_);
}

void LayoutController::askName() {
  auto* dialog = new QInputDialog(&window_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Save the layout"));
  dialog->setLabelText(tr("Name of the layout; an existing name is replaced:"));
  dialog->setComboBoxEditable(true);
  dialog->setComboBoxItems(names());
  dialog->setTextValue({});
  connect(dialog, &QInputDialog::textValueSelected, this, [this](const QString& name) {
    if (!name.trimmed().isEmpty()) store(name.trimmed());
  });
  dialog->open();
}

}  // namespace capstan::widgets
