#include "widgets/shell/main_window.h"

#include <QAction>
#include <QActionGroup>
#include <QDir>
#include <QDockWidget>
#include <QFileInfo>
#include <QStackedWidget>

#include "widgets/panels/calibration/calibration_panel.h"
#include "widgets/panels/diagnosis/diagnosis_panel.h"
#include "widgets/panels/errors/errors_panel.h"
#include "widgets/panels/filter/filter_panel.h"
#include "widgets/panels/health/health_panel.h"
#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/learning/learning_panel.h"
#include "widgets/panels/marker/marker_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/replay/replay_bar.h"
#include "widgets/scene/scene_view.h"
#include "widgets/shell/analysis_controller.h"
#include "widgets/shell/analysis_pages.h"
#include "widgets/shell/calibration_controller.h"
#include "widgets/shell/compare_controller.h"
#include "widgets/shell/diagnosis_controller.h"
#include "widgets/shell/dock_layout.h"
#include "widgets/shell/dock_scroll.h"
#include "widgets/shell/drive_controller.h"
#include "widgets/shell/export_controller.h"
#include "widgets/shell/filter_controller.h"
#include "widgets/shell/health_controller.h"
#include "widgets/shell/identification_controller.h"
#include "widgets/shell/learning_controller.h"
#include "widgets/shell/marker_controller.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/monitor_controller.h"
#include "widgets/shell/motor_controller.h"
#include "widgets/shell/plots_controller.h"
#include "widgets/shell/recover_controller.h"
#include "widgets/shell/registration_controller.h"
#include "widgets/shell/replay_controller.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/source_menu.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {

/// Adds the panels around the plots, and the controllers that connect them with the session.
void MainWindow::addDocks() {
  const auto dock = [&](const QString& name, const QString& title, QWidget* content,
                        Qt::DockWidgetArea area) {
    auto* frame = new QDockWidget(title, this);
    frame->setObjectName(name);
    content->setAttribute(Qt::WA_StyledBackground);
    frame->setWidget(new DockScroll(content));
    addDockWidget(area, frame);
    return frame;
  };
  dock("cameras", tr("Cameras"), video_ = themed(new StereoView), Qt::LeftDockWidgetArea);
  dock("scene", tr("Scene"), scene_ = themed(new SceneView), Qt::LeftDockWidgetArea);
  dock("occlusion", tr("Occlusion"), occlusion_ = themed(new OcclusionPanel), Qt::RightDockWidgetArea);
  auto* identification = dock("identification", tr("Identification"),
                              identification_ = themed(new IdentificationPanel), Qt::RightDockWidgetArea);
  dock("errors", tr("Errors (RMS)"), errors_ = themed(new ErrorsPanel), Qt::RightDockWidgetArea);
  dock("notes", tr("Notes"), notes_ = themed(new NotesPanel), Qt::RightDockWidgetArea);
  const auto floating = [&](const QString& name, const QString& title, QWidget* content) {
    auto* frame = dock(name, title, content, Qt::RightDockWidgetArea);
    floatOverCentre(*this, *frame);
    return frame;
  };
  auto* health = themed(new HealthPanel);
  new HealthController(*health, *floating("health", tr("Estimator health"), health), *errors_, *status_,
                       link_, this);
  auto* calibration = themed(new CalibrationPanel);
  new CalibrationController(*calibration, *floating("calibration", tr("Camera calibration"), calibration),
                            link_, this);
  auto* filter = themed(new FilterPanel);
  floating("filter", tr("Filter options"), filter);
  new FilterController(*filter, link_, *notes_, *undo_, this);
  auto* marker = themed(new MarkerPanel);
  new MarkerController(*marker, *floating("marker", tr("Marker"), marker), link_, *bar_, this);
  registration_dock_ =
      floating("registration", tr("Registration"), registration_ = themed(new RegistrationPanel));
  const QDir folder = QFileInfo(settings_->fileName()).dir();
  new RegistrationController({*registration_, *registration_dock_, *scene_, *notes_, *registration_news_,
                              *undo_, folder.filePath("registrations.yaml").toStdString()},
                             link_, *bar_, this);
  new DriveController({*registration_, *registration_dock_, *status_, *notes_}, link_, this);
  new IdentificationController(*identification_, *identification, link_, *bar_, *notes_, this);
  auto* errors = new AnalysisController(analysis_->errors(), *centre_, link_, *bar_, *errors_, *notes_, this);
  export_ = new ExportController({*figure_, *notes_, *messages_, *export_news_}, *errors, link_, *bar_, this);
  auto* recover = new RecoverController(*messages_, *export_news_, link_, this);
  connect(&bar_->sources(), &SourceMenu::recoverRequested, recover, &RecoverController::askDamaged);
  new DiagnosisController(*diagnosis_, *centre_, link_, *bar_, *identification_, *notes_, this);
  new LearningController(*learning_, *centre_, link_, *bar_, *notes_, this);
  auto* in_the_centre = new QActionGroup(this);  // one at a time, or the plots
  in_the_centre->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
  for (const char* name : {"analyse", "diagnose", "learn"}) in_the_centre->addAction(action(name));
  new MotorController(*figure_, link_, *bar_, *messages_, *notes_, this);
  new PlotsController(*figure_, link_, *notes_, *bar_, this);
  new ReplayController(*replay_, {*figure_, *video_, *scene_, *notes_, *messages_}, link_, this);
  compare_ = themed(new CompareController({*plots_, *figure_, *compare_news_}, link_, this));
  monitor_ = new MonitorController(link_, *bar_, *messages_, *notes_, this);
}

}  // namespace capstan::widgets
