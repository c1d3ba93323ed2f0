#include "widgets/shell/session_bar.h"

#include <QAction>
#include <QComboBox>
#include <QDesktopServices>
#include <QDir>
#include <QEvent>
#include <QFileDialog>
#include <QPainter>
#include <QToolButton>
#include <QUrl>

#include "core/base/error.h"
#include "core/recording/disk_space.h"
#include "widgets/shell/source_menu.h"

namespace capstan::widgets {

using live::RunState;

SessionBar::SessionBar(QWidget* parent) : QToolBar(tr("Session"), parent) {
  setObjectName("session");
  drawMore();
  setMovable(false);
  run_ = add("run", tr("▸ Run"), Qt::Key_Space, tr("Run or pause"));
  run_->setCheckable(true);
  connect(run_, &QAction::triggered, this, [this] { Q_EMIT runToggled(); });
  step_ = add("step", tr("Step"), Qt::Key_Period, tr("Step to the next camera sample"));
  connect(step_, &QAction::triggered, this, &SessionBar::stepRequested);
  addSpeed();
  addSeparator();
  addSources();
  addRecording();
  addSeparator();
  addExport();
  addGap();
  auto* note = add("note", tr("Note"), Qt::Key_N, tr("Write a note at the present moment"));
  connect(note, &QAction::triggered, this, &SessionBar::noteRequested);
  auto* help = add("help", tr("Manual"), QKeySequence::HelpContents, tr("The manual, at the panel in use"));
  help->setShortcutContext(Qt::ApplicationShortcut);  // in floating docks and dialogs too
  connect(help, &QAction::triggered, this, &SessionBar::helpRequested);
  auto* theme =
      add("theme", tr("Dark or light"), QKeySequence(QStringLiteral("Ctrl+T")), tr("Dark or light"));
  connect(theme, &QAction::triggered, this, &SessionBar::themeToggled);
  showAsSign(*note, QStringLiteral("✎"));
  showAsSign(*help, QStringLiteral("?"));
  showAsSign(*theme, QStringLiteral("◐"));
}

/// The button for actions without room shows a sign in the theme's colour: the style's own is dark on dark.
void SessionBar::drawMore() {
  auto* more = findChild<QToolButton*>("qt_toolbar_ext_button");
  if (!more) return;
  constexpr int kSide = 16;  // [px]
  QPixmap sign(QSize(kSide, kSide) * devicePixelRatioF());
  sign.setDevicePixelRatio(devicePixelRatioF());
  sign.fill(Qt::transparent);
  QPainter painter(&sign);
  QFont bold = font();
  bold.setBold(true);
  painter.setFont(bold);
  painter.setPen(palette().color(QPalette::ButtonText));
  painter.drawText(QRect(0, 0, kSide, kSide), Qt::AlignCenter, QStringLiteral("»"));
  painter.end();
  more->setIcon(sign);
  more->setToolTip(tr("Actions without room here; all actions are also in the menus above"));
}

void SessionBar::changeEvent(QEvent* event) {
  QToolBar::changeEvent(event);
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange) drawMore();
}

QAction* SessionBar::add(const QString& name, const QString& text, const QKeySequence& key,
                         const QString& tip) {
  auto* action = addAction(text);
  action->setObjectName(name);
  action->setShortcut(key);
  action->setAutoRepeat(name == "step");
  action->setToolTip(QStringLiteral("%1 (%2)").arg(tip, key.toString(QKeySequence::NativeText)));
  if (auto* button = qobject_cast<QToolButton*>(widgetForAction(action))) button->setFocusPolicy(Qt::NoFocus);
  return action;
}

/// The button shows a sign, and the menus the words.
void SessionBar::showAsSign(QAction& action, const QString& sign) {
  action.setIconText(sign);
  if (auto* button = widgetForAction(&action)) button->setAccessibleName(action.text());
}

void SessionBar::addSpeed() {
  speed_ = new QComboBox;
  speed_->setObjectName("speed");
  speed_->setToolTip(tr("Speed of the session, slower [ and faster ]"));
  for (const double speed : {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0})
    speed_->addItem(QStringLiteral("×%1").arg(speed), speed);
  speed_->setCurrentIndex(speed_->findData(1.0));
  speed_->setFocusPolicy(Qt::NoFocus);
  addWidget(speed_)->setText(tr("Speed"));
  connect(speed_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          [this] { Q_EMIT speedChanged(speed()); });
  shifts_ = {addOffBar("slower", tr("Slower"), Qt::Key_BracketLeft, [this] { shiftSpeed(-1); }),
             addOffBar("faster", tr("Faster"), Qt::Key_BracketRight, [this] { shiftSpeed(1); })};
}

/// Adds an action that is only in the window's menus; its key works too.
QAction* SessionBar::addOffBar(const QString& name, const QString& text, const QKeySequence& key,
                               std::function<void()> act) {
  auto* action = new QAction(text, parentWidget());
  action->setObjectName(name);
  action->setShortcut(key);
  parentWidget()->addAction(action);
  connect(action, &QAction::triggered, this, std::move(act));
  return action;
}

void SessionBar::shiftSpeed(int by) {
  speed_->setCurrentIndex(qBound(0, speed_->currentIndex() + by, speed_->count() - 1));
}

double SessionBar::speed() const { return speed_->currentData().toDouble(); }

void SessionBar::setSpeed(double speed) {
  const int index = speed_->findData(speed);
  if (index >= 0) speed_->setCurrentIndex(index);
}

void SessionBar::addSources() {
  sources_ = new SourceMenu(parentWidget());
  sources_->setTitle(tr("Source"));
  sources_->setToolTip(tr("Simulate, or open a recording"));
  parentWidget()->addActions(sources_->actions());  // so that their keys work while the menu is shut
  addAction(sources_->menuAction());
  if (auto* button = qobject_cast<QToolButton*>(widgetForAction(sources_->menuAction()))) {
    button->setPopupMode(QToolButton::InstantPopup);
    button->setFocusPolicy(Qt::NoFocus);
  }
}

void SessionBar::addRecording() {
  record_ = add("record", tr("● Record"), Qt::Key_R, tr("Record the session to a file, or stop"));
  record_->setCheckable(true);
  connect(record_, &QAction::triggered, this, &SessionBar::recordToggled);
  auto* button = qobject_cast<QToolButton*>(widgetForAction(record_));
  auto* menu = new QMenu(button);
  menu->addAction(addOffBar("recordingFolder", tr("Recording folder…"), {}, [this] { askFolder(); }));
  menu->addAction(addOffBar("showFolder", tr("Show the folder"), {},
                            [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(folder_)); }));
  button->setMenu(menu);
  button->setPopupMode(QToolButton::MenuButtonPopup);
}

void SessionBar::addExport() {
  export_ = add("export", tr("Export"), QKeySequence(QStringLiteral("Ctrl+E")),
                tr("Save the plots as PDF, SVG, PNG and their numbers as CSV"));
  connect(export_, &QAction::triggered, this, &SessionBar::exportRequested);
  auto* button = qobject_cast<QToolButton*>(widgetForAction(export_));
  auto* menu = new QMenu(button);
  menu->addAction(addOffBar("exportEverything", tr("Export everything…"), QStringLiteral("Ctrl+Shift+X"),
                            [this] { Q_EMIT exportEverythingRequested(); }));
  button->setMenu(menu);
  button->setPopupMode(QToolButton::MenuButtonPopup);
}

void SessionBar::addPanelAction(QAction* action) {
  insertAction(export_, action);
  if (auto* button = qobject_cast<QToolButton*>(widgetForAction(action))) button->setFocusPolicy(Qt::NoFocus);
}

void SessionBar::addGap() {
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  addWidget(gap)->setSeparator(true);  // as which it stands in the menu of what has no room
}

void SessionBar::askFolder() {
  auto* dialog = new QFileDialog(parentWidget(), tr("Folder for recordings"), folder_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, this, &SessionBar::chooseRecordingFolder);
  dialog->open();
}

void SessionBar::chooseRecordingFolder(const QString& folder) {
  try {
    recording::checkRecordingFolder(folder.toStdString());
    setRecordingFolder(folder);
  } catch (const base::InputError& error) {
    Q_EMIT recordingFolderRefused(QString::fromStdString(error.what()));
  }
}

void SessionBar::setRecordingFolder(const QString& folder) {
  folder_ = folder;
  record_->setToolTip(tr("Record to %1, or stop (R)").arg(QDir::toNativeSeparators(folder)));
  Q_EMIT recordingFolderChanged(folder);
}

void SessionBar::showStatus(const live::RunStatus& status) {
  const bool running = status.state == RunState::kRunning;
  run_->setChecked(running);
  run_->setText(running ? tr("‖ Pause") : status.state == RunState::kEnded ? tr("↻ Again") : tr("▸ Run"));
  const bool live = !status.sides.empty();  // it goes on in real time
  step_->setEnabled(!live && (status.state == RunState::kPaused || running));
  speed_->setEnabled(!live);
  for (QAction* shift : shifts_) shift->setEnabled(!live);
  const bool recording = status.recorder && status.recorder->state == recording::RecorderState::kRecording;
  record_->setChecked(recording);
  record_->setText(recording ? tr("■ Stop") : tr("● Record"));
}

}  // namespace capstan::widgets
