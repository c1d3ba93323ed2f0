#include "widgets/shell/main_window.h"

#include <QAction>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileInfo>
#include <QMenuBar>
#include <QSplitter>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QStatusBar>
#include <QVBoxLayout>
#include <utility>

#include "core/base/error.h"
#include "core/recording/session_file.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/diagnosis/diagnosis_panel.h"
#include "widgets/panels/errors/errors_panel.h"
#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/learning/learning_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/panels/registration/poses_page.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/replay/replay_bar.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/scene/scene_view.h"
#include "widgets/shell/analysis_pages.h"
#include "widgets/shell/dock_layout.h"
#include "widgets/shell/dock_scroll.h"
#include "widgets/shell/help_topics.h"
#include "widgets/shell/help_window.h"
#include "widgets/shell/keyboard_reach.h"
#include "widgets/shell/layout_controller.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/occlusion_controller.h"
#include "widgets/shell/recent_menu.h"
#include "widgets/shell/recording_offer.h"
#include "widgets/shell/robot_controller.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/settings_undo.h"
#include "widgets/shell/settings_watch.h"
#include "widgets/shell/source_menu.h"
#include "widgets/shell/units_dialog.h"
#include "widgets/shell/unsaved_poses.h"
#include "widgets/shell/window_menus.h"
#include "widgets/shell/window_title.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {

namespace {

QString documents() {
  return QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + "/Capstan";
}

/// The widgets one below the other, of which `tall` takes the room.
QWidget* column(std::initializer_list<QWidget*> widgets, QWidget* tall) {
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  for (QWidget* widget : widgets) layout->addWidget(widget, widget == tall ? 1 : 0);
  return box;
}

}  // namespace

MainWindow::MainWindow(const QString& settings, QWidget* parent)
    : QMainWindow(parent),
      settings_(settings.isEmpty() ? std::make_unique<QSettings>("Capstan", "Capstan")
                                   : std::make_unique<QSettings>(settings, QSettings::IniFormat)) {
  setDockNestingEnabled(true);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  messages_ = themed(new MessageBar);
  figure_ = new JointFigure(history_);
  centre_ = new QStackedWidget;
  plots_ = new QSplitter;
  plots_->addWidget(figure_);
  plots_->setChildrenCollapsible(false);
  centre_->addWidget(column({plots_, replay_ = themed(new ReplayBar(history_))}, plots_));
  centre_->addWidget(new DockScroll(analysis_ = themed(new AnalysisPages)));
  centre_->addWidget(new DockScroll(diagnosis_ = themed(new DiagnosisPanel(runDiagnosis))));
  centre_->addWidget(new DockScroll(learning_ = themed(new LearningPanel)));
  news_ = themed(new MessageBar);
  export_news_ = themed(new MessageBar);
  compare_news_ = themed(new MessageBar);
  registration_news_ = themed(new MessageBar);
  setCentralWidget(
      column({messages_, news_, registration_news_, export_news_, compare_news_, centre_}, centre_));
  status_ = themed(new StatusLine);
  statusBar()->addWidget(status_, 1);
  bar_ = new SessionBar(this);
  undo_ = new SettingsUndo(this);
  addActions({undo_->undoAction(), undo_->redoAction()});
  auto* menus = addBars();
  addDocks();
  layouts_ = new LayoutController(*this, *settings_, *undo_);
  addMenus(*this, *menus);
  status_->setRemedies({action("identify"), action("diagnose")});
  new KeyboardReach(this);
  connectBar();
  connectLink();
  occlusion_controller_ = new OcclusionController(*occlusion_, link_, *notes_, this);
  connectNotes();
  new RobotController(link_, *status_, *notes_, this);
  restore();
  new SettingsWatch(*this, *occlusion_, *undo_);
}

MainWindow::~MainWindow() = default;

/// Adds the menus above the toolbar. The toolbar is outside the window's toolbar areas, so that actions
/// without room go into a menu.
QMenuBar* MainWindow::addBars() {
  auto* menus = new QMenuBar;
  setMenuWidget(column({menus, bar_}, bar_));
  return menus;
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (std::exchange(laid_out_, true)) return keepWhole(*this);
  layOutDocks(*this);
}

void MainWindow::connectBar() {
  connect(bar_, &SessionBar::runToggled, this, [this] {
    if (link_.ended() && !link_.opening())
      open(choice_);
    else
      link_.setRunning(!link_.running());
  });
  connect(bar_, &SessionBar::stepRequested, this, [this] {
    if (link_.runner()) link_.runner()->stepFrame();
  });
  connect(bar_, &SessionBar::speedChanged, this, [this](double speed) {
    if (link_.runner()) link_.runner()->setSpeed(speed);
    replay_->setSpeed(speed);
  });
  connect(bar_, &SessionBar::recordToggled, this, [this] { link_.toggleRecording(bar_->recordingFolder()); });
  connect(bar_, &SessionBar::recordingFolderChanged, status_, &StatusLine::setFolder);
  connect(bar_, &SessionBar::recordingFolderRefused, messages_,
          [this](const QString& why) { messages_->showMessage(why); });
  connect(bar_, &SessionBar::noteRequested, this, [this] {
    auto* dock = findChild<QDockWidget*>("notes");
    dock->show();
    dock->raise();
    notes_->beginNote();
  });
  connect(bar_, &SessionBar::helpRequested, this, &MainWindow::showHelp);
  connect(bar_, &SessionBar::themeToggled, this,
          [this] { setThemeNamed(theme_.isDark() ? "light" : "dark"); });
  connect(&bar_->sources(), &SourceMenu::chosen, this, &MainWindow::open);
  auto* offer = new RecordingOffer(*news_, link_, this);
  connect(offer, &RecordingOffer::recorded, &bar_->sources().recent(), &RecentMenu::remember);
  connect(offer, &RecordingOffer::openRequested, this,
          [this](const QString& file) { open(SourceChoice::ofFile(file)); });
  connect(offer, &RecordingOffer::analyseRequested, this, &MainWindow::analyse);
}

void MainWindow::analyse(const QString& recording) {
  analysis_->setCurrentIndex(0);  // errors of runs
  analysis_->errors().choose(0, {RunChoice::Kind::kRecording, recording});
  action("analyse")->setChecked(true);
}

void MainWindow::connectLink() {
  connect(&link_, &SessionLink::opened, this, &MainWindow::onOpened);
  connect(&link_, &SessionLink::failed, this, [this](const QString& text) {
    messages_->showMessage(text);
    notes_->addEvent(now_, "fault", text);
    title_ = link_.runner() ? titleOf(choice_, link_.runner()->info().title) : tr("no source");
  });
  connect(&link_, &SessionLink::unitsAsked, this, &MainWindow::askUnits);
  connect(&link_, &SessionLink::status, this, &MainWindow::onStatus);
  connect(&link_, &SessionLink::report, this, [this](const auto& report) { errors_->showReport(report); });
  connect(&link_, &SessionLink::history, this, [this](const std::vector<tracking::Snapshot>& snapshots) {
    for (const auto& snapshot : snapshots) history_.append(snapshot);
    figure_->refresh();
  });
  connect(&link_, &SessionLink::snapshot, this, [this](const tracking::Snapshot& snapshot) {
    now_ = snapshot.t;
    if (!replay_->reviewing()) scene_->showSnapshot(snapshot);
    occlusion_->showSnapshot(snapshot);
    status_->showSnapshot(snapshot);
  });
  connect(&link_, &SessionLink::frames, this,
          [this](const tracking::StereoFrame& frame, const tracking::Snapshot& seen) {
            if (!replay_->reviewing()) video_->showFrames(frame.left, frame.right, seen);
          });
}

void MainWindow::connectNotes() {
  connect(errors_, &ErrorsPanel::resetRequested, this, [this] {
    if (link_.runner()) link_.runner()->resetErrors();
    notes_->addEvent(now_, "errors", tr("restarted"));
  });
  connect(notes_, &NotesPanel::noteWritten, this, [this](const QString& text) {
    if (link_.runner()) link_.runner()->note(text.toStdString());
    notes_->addEvent(now_, "note", text);
  });
  connect(notes_, &NotesPanel::timeChosen, this, [this](double t) {
    if (history_.empty() || t < history_.begin() || t > history_.end()) return;
    replay_->review(t);
  });
}

void MainWindow::open(const SourceChoice& choice) {
  title_ = tr("opening…");
  link_.open(choice);
}

/// Asks for the units of a table. The table is not tracked before they are chosen, and the open session
/// stays.
void MainWindow::askUnits(const recording::ImplausibleUnits& refused, const SourceChoice& choice) {
  title_ = link_.runner() ? QString::fromStdString(link_.runner()->info().title) : tr("no source");
  auto* dialog = new UnitsDialog(refused, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &UnitsDialog::chosen, this, [this, choice](const QString& read_as) {
    SourceChoice settled = choice;
    const auto said = [](const QString& text) {
      return recording::parseReadAs(text.toStdString(), "--read-as");
    };
    settled.read_as = QString::fromStdString(
        recording::formatReadAs(recording::overlaid(said(choice.read_as), said(read_as))));
    open(settled);
  });
  dialog->show();
}

void MainWindow::onOpened(const tracking::SourceInfo& info, const SourceChoice& choice) {
  choice_ = choice;
  bar_->sources().remember(choice_);
  if (messages_->about() != "recording") messages_->hide();  // an old fault is none of this source
  history_.clear();
  now_ = info.begin;
  title_ = titleOf(choice_, info.title);
  status_->setSource(choice_.isRecording() ? tr("recording %1").arg(QFileInfo(choice_.file).fileName())
                                           : QString());
  std::array<QString, 3> names;
  for (std::size_t i = 0; i < 3; ++i)
    names[i] = i < info.robot.joints.size() ? QString::fromStdString(info.robot.joints[i].name)
                                            : tr("joint %1").arg(i + 1);
  figure_->setJointNames(names);
  figure_->setLive(info.real_time);
  figure_->setFollowing(true);
  scene_->setRobot(info.robot, info.rig, info.base_from_camera);
  if (!info.rig) video_->clear(tr("this source has no images"));
  errors_->setReference(info.reference);
  notes_->clear();
  recording_since_.reset();  // that was of the session before
  sides_ = {};
  refusals_.clear();
  pauses_ = live::PauseWatch(info.sender_waits);
  notes_->setRecording(false);
  notes_->addEvent(now_, "source", title_);
  for (const std::string& notice : info.notices)
    notes_->addEvent(now_, "notice", QString::fromStdString(notice));
  if (info.own_kinematics)
    notes_->addEvent(now_, "notice", tr("reference: the robot's own kinematics, no truth"));
  listRecordedEvents();
  link_.runner()->setSpeed(info.real_time ? 1.0 : bar_->speed());
  occlusion_controller_->begin(info);
  link_.setRunning(true);
}

void MainWindow::listRecordedEvents() {
  if (!choice_.isRecording() || !choice_.file.endsWith(recording::kSessionSuffix)) return;
  try {
    for (const auto& event : recording::readSessionEvents(choice_.file.toStdString()))
      notes_->addEvent(event.t, QString::fromStdString(event.kind), QString::fromStdString(event.text));
  } catch (const base::InputError& error) {
    messages_->showMessage(QString::fromStdString(error.what()));
  }
}

void MainWindow::onStatus(const live::RunStatus& status) {
  const bool recording = status.recorder && status.recorder->state == recording::RecorderState::kRecording;
  if (recording != recording_since_.has_value()) onRecording(recording, status);
  status_->showStatus(status, status.t - recording_since_.value_or(status.t));
  occlusion_->showBlocked(status.blocked);
  video_->setOutdated(status.sides);
  for (const std::string& change : sides_.observe(status.sides))
    notes_->addEvent(status.t, "source", QString::fromStdString(change));
  showRefusal(status.sides);
  notePause(status);
  bar_->showStatus(status);
  const QString title = titleOfWindow(title_, status, recording_since_ ? status.t - *recording_since_ : -1.0);
  if (title != windowTitle()) setWindowTitle(title);
}

/// Shows why data were refused, whole and with the remedy, until others come. What was closed comes again
/// with another reason only.
void MainWindow::showRefusal(const std::vector<tracking::SideStatus>& sides) {
  for (const tracking::SideStatus& side : sides) {
    const QString about = QString::fromStdString(side.name);
    Refusal& last = refusals_[side.name];
    if (side.state == tracking::SideStatus::State::kReceiving) {
      messages_->settle(about);
      last = {side.refused, {}};
    } else if (side.refused > last.count && side.fault != last.shown && messages_->about() != "recording") {
      last = {side.refused, side.fault};
      messages_->showMessage(tr("%1 refused: %2").arg(about, QString::fromStdString(side.fault)), about);
    }
  }
}

/// The pause of a recording that is played is none of the session.
void MainWindow::notePause(const live::RunStatus& status) {
  if (!link_.runner()->info().real_time) return;
  const bool paused = status.state == live::RunState::kPaused;
  if (!paused && status.t == 0.0) return;  // nothing has come
  if (const auto change = pauses_.observe(paused, status.t, live::PauseWatch::Clock::now()))
    notes_->addEvent(status.t, "session", QString::fromStdString(*change));
}

void MainWindow::onRecording(bool recording, const live::RunStatus& status) {
  if (recording) {
    recording_since_ = status.t;
    messages_->settle("recording");
    const QFileInfo file(QString::fromStdString(status.recording));
    notes_->addFile(status.t, "recording", file.absoluteFilePath());
  } else {
    recording_since_.reset();
    const bool failed = status.recorder && status.recorder->state == recording::RecorderState::kFailed;
    const QString why = failed ? QString::fromStdString(status.recorder->error) : QString();
    if (failed) messages_->showMessage(why, "recording");
    notes_->addEvent(status.t, failed ? "fault" : "recording", failed ? why : tr("stopped"));
    if (const auto gaps = status.recorder ? status.recorder->dropped : 0; gaps > 0 && !failed) {
      const QString missing = QString::fromStdString(recording::gapsText(gaps));
      messages_->showMessage(missing, "recording");
      notes_->addEvent(status.t, "fault", missing);
    }
  }
  notes_->setRecording(recording);
}

void MainWindow::showHelp() {
  if (!help_) help_ = new HelpWindow(this);
  if (!help_->isActiveWindow()) help_->show(topicOf(QApplication::focusWidget()));
}

void MainWindow::setThemeNamed(const QString& name) {
  theme_ = Theme::named(name);
  applyTheme(*qApp, theme_);
  figure_->setTheme(theme_.isDark() ? Theme::dark() : Theme::light());
  Q_EMIT themeChanged(theme_);
}

AnalysisPanel& MainWindow::analysis() { return analysis_->errors(); }

QString MainWindow::message() const { return messages_->message(); }

void MainWindow::restore() {
  choice_ = SourceChoice::restore(*settings_);
  bar_->sources().recent().setFiles(settings_->value("source/recent").toStringList());
  if (choice_.simulated || !choice_.file.isEmpty()) bar_->sources().remember(choice_);
  bar_->setRecordingFolder(settings_->value("recording/folder", documents()).toString());
  setThemeNamed(settings_->value("theme", "dark").toString());
  analysis_->restore(*settings_);
  diagnosis_->restore(*settings_);
  learning_->restore(*settings_);
  restoreGeometry(settings_->value("geometry").toByteArray());
  laid_out_ = layouts_->restoreLast();
  for (const char* name : {"health", "calibration", "filter", "marker", "registration"})
    findChild<QDockWidget*>(name)->hide();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!settleUnsavedPoses(registration_->posesPage(), bar_->recordingFolder(), this)) return event->ignore();
  if (link_.recording()) link_.runner()->stopRecording();
  settings_->setValue("theme", theme_.name);
  settings_->setValue("geometry", saveGeometry());
  layouts_->saveLast();
  settings_->setValue("recording/folder", bar_->recordingFolder());
  settings_->setValue("source/recent", bar_->sources().recent().files());
  choice_.save(*settings_);
  analysis_->save(*settings_);
  diagnosis_->save(*settings_);
  learning_->save(*settings_);
  QMainWindow::closeEvent(event);
}

}  // namespace capstan::widgets
