#include "widgets/shell/main_window.h"

#include <QAction>
#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenu>
#include <QStandardPaths>
#include <QStatusBar>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/simulation/simulated_source.h"
#include "widgets/panels/errors/errors_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/scene/scene_view.h"
#include "widgets/shell/message_bar.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {

MainWindow::MainWindow(const QString& settings, QWidget* parent)
    : QMainWindow(parent),
      settings_(settings.isEmpty() ? std::make_unique<QSettings>("Capstan", "Capstan")
                                   : std::make_unique<QSettings>(settings, QSettings::IniFormat)) {
  setDockNestingEnabled(true);
  auto* middle = new QWidget;
  auto* column = new QVBoxLayout(middle);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  messages_ = new MessageBar;
  figure_ = new JointFigure(history_);
  column->addWidget(messages_);
  column->addWidget(figure_, 1);
  setCentralWidget(middle);
  status_ = new StatusLine;
  statusBar()->addWidget(status_, 1);
  addDocks();
  addToolBar();
  connectLink();
  connectPanels();
  restore();
}

MainWindow::~MainWindow() = default;

void MainWindow::addDocks() {
  const auto dock = [&](const QString& name, const QString& title, QWidget* content,
                        Qt::DockWidgetArea area) {
    auto* frame = new QDockWidget(title, this);
    frame->setObjectName(name);
    frame->setWidget(content);
    addDockWidget(area, frame);
    return frame;
  };
  auto* cameras = dock("cameras", tr("Cameras"), video_ = new StereoView, Qt::LeftDockWidgetArea);
  auto* scene = dock("scene", tr("Scene"), scene_ = new SceneView, Qt::LeftDockWidgetArea);
  auto* right = dock("occlusion", tr("Occlusion"), occlusion_ = new OcclusionPanel, Qt::RightDockWidgetArea);
  dock("errors", tr("Errors (RMS)"), errors_ = new ErrorsPanel, Qt::RightDockWidgetArea);
  registration_dock_ = dock("registration", tr("Registration"), registration_ = new RegistrationPanel,
                            Qt::RightDockWidgetArea);
  registration_dock_->setFloating(true);
  registration_dock_->hide();
  resizeDocks({cameras, right}, {430, 290}, Qt::Horizontal);
  resizeDocks({cameras, scene}, {560, 330}, Qt::Vertical);
}

QAction* MainWindow::addAct(QToolBar* bar, const QString& name, const QString& text, const QKeySequence& key,
                            const QString& tip) {
  auto* action = bar->addAction(text);
  action->setObjectName(name);
  action->setShortcut(key);
  action->setToolTip(QStringLiteral("%1 (%2)").arg(tip, key.toString()));
  return action;
}

void MainWindow::addToolBar() {
  auto* bar = QMainWindow::addToolBar(tr("Session"));
  bar->setObjectName("session");
  run_ = addAct(bar, "run", tr("Run"), Qt::Key_Space, tr("Run or pause"));
  run_->setCheckable(true);
  connect(run_, &QAction::triggered, this, [this](bool on) { link_.setRunning(on); });
  connect(addAct(bar, "step", tr("Step"), Qt::Key_Period, tr("On to the next camera sample")),
          &QAction::triggered, this, [this] {
            if (link_.runner()) link_.runner()->stepFrame();
          });
  speed_ = new QComboBox;
  speed_->setToolTip(tr("Speed of the session"));
  for (const double speed : {0.25, 0.5, 1.0, 2.0, 5.0, 10.0})
    speed_->addItem(QStringLiteral("×%1").arg(speed), speed);
  speed_->setCurrentIndex(2);
  speed_->setFocusPolicy(Qt::NoFocus);
  bar->addWidget(speed_);
  connect(speed_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this] {
    if (link_.runner()) link_.runner()->setSpeed(speed_->currentData().toDouble());
  });
  bar->addSeparator();
  addSourceMenu(bar);
  record_ = addAct(bar, "record", tr("● Record"), Qt::Key_R, tr("Record the session to a file, or stop"));
  record_->setCheckable(true);
  connect(record_, &QAction::triggered, this, [this] {
    link_.toggleRecording(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + "/Capstan");
  });
  auto* registering = registration_dock_->toggleViewAction();
  registering->setText(tr("Register"));
  registering->setToolTip(tr("Find the cameras' place at the hard stop"));
  bar->addAction(registering);
  auto* gap = new QWidget;
  gap->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  bar->addWidget(gap);
  connect(addAct(bar, "theme", tr("◐ Theme"), QKeySequence(QStringLiteral("Ctrl+T")), tr("Dark or light")),
          &QAction::triggered, this, [this] { setThemeNamed(theme_.isDark() ? "light" : "dark"); });
}

void MainWindow::addSourceMenu(QToolBar* bar) {
  auto* button = new QToolButton;
  button->setText(tr("Source"));
  button->setPopupMode(QToolButton::InstantPopup);
  button->setFocusPolicy(Qt::NoFocus);
  auto* menu = new QMenu(button);
  for (const char* trajectory : {"fls", "sinusoid", "hold"})
    for (const char* truth : {"default", "matched"})
      connect(menu->addAction(tr("Simulated: %1, %2 truth").arg(trajectory, truth)), &QAction::triggered,
              this, [this, trajectory, truth] {
                SourceChoice choice;
                choice.trajectory = trajectory;
                choice.truth = truth;
                choice.seed = choice_.seed;
                open(choice);
              });
  menu->addSeparator();
  connect(menu->addAction(tr("Open session or table…")), &QAction::triggered, this, [this] {
    auto* dialog =
        new QFileDialog(this, tr("Open a recording"), {}, tr("Recordings (*.capstan *.csv);;All files (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
      SourceChoice choice;
      choice.simulated = false;
      choice.file = file;
      open(choice);
    });
    dialog->show();
  });
  button->setMenu(menu);
  bar->addWidget(button);
}

void MainWindow::connectLink() {
  connect(&link_, &SessionLink::opened, this, &MainWindow::onOpened);
  connect(&link_, &SessionLink::failed, messages_, &MessageBar::showMessage);
  connect(&link_, &SessionLink::status, this, &MainWindow::onStatus);
  connect(&link_, &SessionLink::report, this,
          [this](const auto& report) { errors_->showErrors(report.errors); });
  connect(&link_, &SessionLink::history, this, [this](const std::vector<tracking::Snapshot>& snapshots) {
    for (const auto& snapshot : snapshots) {
      history_.append(snapshot);
      if (registration_->active() && snapshot.camera_updated) registration_->showSnapshot(snapshot);
    }
    figure_->refresh();
  });
  connect(&link_, &SessionLink::snapshot, this, [this](const tracking::Snapshot& snapshot) {
    snapshot_ = snapshot;
    scene_->showSnapshot(snapshot);
    occlusion_->showSnapshot(snapshot);
    status_->showSnapshot(snapshot);
  });
  connect(&link_, &SessionLink::frames, this, [this](const tracking::StereoFrame& frame) {
    video_->showFrames(frame.left, frame.right, snapshot_);
    if (registration_->active()) registration_->showFrames(frame.left, frame.right, snapshot_);
  });
}

void MainWindow::connectPanels() {
  connect(occlusion_, &OcclusionPanel::blockChanged, this, [this](bool left, bool right) {
    if (link_.runner()) link_.runner()->block(left, right);
  });
  connect(occlusion_, &OcclusionPanel::scheduleChanged, this,
          [this](const session::OcclusionSchedule& schedule) {
            if (link_.runner()) link_.runner()->setOcclusion(schedule);
          });
  connect(errors_, &ErrorsPanel::resetRequested, this, [this] {
    if (link_.runner()) link_.runner()->resetErrors();
  });
  const auto command = [this](void (simulation::SimulatedSource::*what)()) {
    if (!link_.runner()) return;
    link_.runner()->post([what](session::Source& source, tracking::TrackingPipeline&) {
      if (auto* simulated = dynamic_cast<simulation::SimulatedSource*>(&source)) (simulated->*what)();
    });
  };
  connect(registration_, &RegistrationPanel::driveToHardStopRequested, this, [this, command] {
    command(&simulation::SimulatedSource::driveToHardStop);
    link_.setRunning(true);
  });
  connect(registration_, &RegistrationPanel::accepted, this,
          [this](const Eigen::Isometry3d& base_from_camera) {
            if (link_.runner()) link_.runner()->setRegistration(base_from_camera);
            scene_->setRegistration(base_from_camera);
          });
  connect(registration_, &RegistrationPanel::finished, this, [this, command] {
    command(&simulation::SimulatedSource::resume);
    registration_dock_->hide();
  });
  connect(registration_dock_, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    if (visible && link_.runner() && !registration_->active())
      registration_->begin(link_.runner()->info(), link_.runner()->info().base_from_camera);
  });
}

void MainWindow::open(const SourceChoice& choice) {
  choice_ = choice;
  title_ = tr("opening…");
  link_.open(choice);
}

void MainWindow::onOpened(const session::SourceInfo& info) {
  history_.clear();
  title_ = QString::fromStdString(info.title);
  std::array<QString, 3> names;
  for (std::size_t i = 0; i < 3 && i < info.robot.joints.size(); ++i)
    names[i] = QString::fromStdString(info.robot.joints[i].name);
  figure_->setJointNames(names);
  figure_->setFollowing(true);
  scene_->setRobot(info.robot, info.rig, info.base_from_camera);
  if (!info.rig) video_->clear(tr("this source has no images"));
  errors_->setReference(info.reference);
  occlusion_->setBlockable(info.rig.has_value());
  link_.runner()->setSpeed(speed_->currentData().toDouble());
  link_.setRunning(true);
}

void MainWindow::onStatus(const session::RunStatus& status) {
  const bool recording = status.recorder && status.recorder->state == session::RecorderState::kRecording;
  if (recording && !recording_since_) recording_since_ = status.t;
  if (!recording) recording_since_.reset();
  status_->showStatus(status, status.t - recording_since_.value_or(status.t));
  occlusion_->showBlocked(status.blocked);
  const bool running = status.state == session::RunState::kRunning;
  run_->setChecked(running);
  run_->setText(running ? tr("‖ Pause") : tr("▸ Run"));
  record_->setChecked(recording);
  retitle(status);
}

void MainWindow::retitle(const session::RunStatus& status) {
  QString title = tr("Capstan ─ %1").arg(title_);
  if (recording_since_)
    title += QStringLiteral(" ─ %1 ● REC %2")
                 .arg(QFileInfo(QString::fromStdString(status.recording)).completeBaseName(),
                      clockText(status.t - *recording_since_));
  if (title != windowTitle()) setWindowTitle(title);
}

void MainWindow::setThemeNamed(const QString& name) {
  theme_ = Theme::named(name);
  applyTheme(*qApp, theme_);
  figure_->setTheme(theme_.isDark() ? Theme::dark() : Theme::light());
  messages_->setTheme(theme_);
  video_->setTheme(theme_);
  scene_->setTheme(theme_);
  occlusion_->setTheme(theme_);
  registration_->setTheme(theme_);
  errors_->setTheme(theme_);
  status_->setTheme(theme_);
}

QString MainWindow::message() const { return messages_->message(); }

void MainWindow::restore() {
  choice_ = SourceChoice::restore(*settings_);
  setThemeNamed(settings_->value("theme", "dark").toString());
  restoreGeometry(settings_->value("geometry").toByteArray());
  restoreState(settings_->value("layout").toByteArray());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (link_.recording()) link_.runner()->stopRecording();
  settings_->setValue("theme", theme_.name);
  settings_->setValue("geometry", saveGeometry());
  settings_->setValue("layout", saveState());
  choice_.save(*settings_);
  QMainWindow::closeEvent(event);
}

}  // namespace capstan::widgets
