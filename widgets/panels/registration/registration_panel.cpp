#include "widgets/panels/registration/registration_panel.h"

#include <QBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedWidget>
#include <QTabWidget>

#include "widgets/panels/registration/camera_strip.h"
#include "widgets/panels/registration/collect_page.h"
#include "widgets/panels/registration/history_page.h"
#include "widgets/panels/registration/poses_page.h"
#include "widgets/panels/registration/result_page.h"
#include "widgets/panels/registration/step_bar.h"
#include "widgets/panels/registration/stop_page.h"

namespace capstan::widgets {

using registration::RegistrationFault;
using registration::RegistrationStep;

RegistrationPanel::RegistrationPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 12, 14, 12);
  column->setSpacing(10);
  tabs_ = new QTabWidget;
  tabs_->setDocumentMode(true);  // no frame within the frame
  tabs_->addTab(makeHardStop(), "Hard stop");
  tabs_->addTab(poses_ = new PosesPage, "Several poses");
  tabs_->addTab(history_ = new HistoryPage, "History");
  tabs_->setTabToolTip(0, "One pose: the position of the cameras; their rotation is known");
  tabs_->setTabToolTip(1, "Position and rotation of the cameras");
  tabs_->setTabToolTip(2, "Earlier registrations: compare, restore, export");
  ended_ = new QLabel(
      "The session has ended: the arm cannot be driven and no frames arrive. Begin it again (Space).");
  ended_->setWordWrap(true);
  ended_->hide();
  close_ = new QPushButton("Cancel");
  auto* bottom = new QHBoxLayout;
  bottom->addWidget(ended_, 1);
  bottom->addStretch();
  bottom->addWidget(close_);
  column->addWidget(cameras_ = new CameraStrip);
  column->addWidget(tabs_, 1);
  column->addLayout(bottom);
  setWindowTitle("Register cameras");
  connect(cameras_, &CameraStrip::remedyRequested, this, &RegistrationPanel::remedyRequested);
  connect(poses_, &PosesPage::accepted, this, &RegistrationPanel::accepted);
  connect(poses_, &PosesPage::rejected, this, &RegistrationPanel::rejected);
  connect(poses_, &PosesPage::decided, this, &RegistrationPanel::decided);
  connect(close_, &QPushButton::clicked, this, [this] {
    leave();
    Q_EMIT finished();
  });
  setTheme(theme_);
}

RegistrationPanel::~RegistrationPanel() = default;

QWidget* RegistrationPanel::makeHardStop() {
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(10);
  steps_ = new StepBar({"Hard stop", "Frames", "Result"});
  pages_ = new QStackedWidget;
  pages_->addWidget(stop_ = new StopPage);
  pages_->addWidget(collect_ = new CollectPage);
  pages_->addWidget(result_ = new ResultPage);
  pages_->addWidget(end_ = new QLabel);
  end_->setAlignment(Qt::AlignCenter);
  end_->setWordWrap(true);
  end_->setFont(textFont(12.0));
  column->addWidget(steps_);
  column->addWidget(pages_, 1);

  connect(stop_, &StopPage::driveRequested, this, &RegistrationPanel::driveToHardStopRequested);
  connect(stop_, &StopPage::overrideChanged, this, [this](bool on) {
    if (guide_) guide_->overrideStop(on);
    refresh();
  });
  const auto collect = [this] {
    if (guide_) guide_->collect();
    refresh();
  };
  connect(stop_, &StopPage::collectRequested, this, collect);
  connect(collect_, &CollectPage::againRequested, this, collect);
  connect(result_, &ResultPage::redoRequested, this, collect);
  connect(collect_, &CollectPage::exchangeRequested, this,
          [this] { Q_EMIT remedyRequested({.correction = {.exchange = true, .mirror = {}, .flip = {}}}); });
  connect(collect_, &CollectPage::backRequested, this, [this] {
    if (guide_) guide_->back();
    refresh();
  });
  connect(result_, &ResultPage::acceptRequested, this, [this] {
    if (!guide_ || !guide_->proposal()) return;
    guide_->accept();
    const auto pose = guide_->proposal()->registration.base_from_camera;
    const auto entry =
        registration::entryOf(registration::Decision::kAccepted, *guide_->proposal(), guide_->scatter());
    registered_ = true;
    finish("The new registration is in use.");
    Q_EMIT accepted(pose, result_->summary());
    Q_EMIT decided(entry);
  });
  connect(result_, &ResultPage::rejectRequested, this, [this](const QString& reason) {
    if (!guide_ || !guide_->proposal()) return;
    auto entry =
        registration::entryOf(registration::Decision::kRejected, *guide_->proposal(), guide_->scatter());
    entry.reason = reason.toStdString();
    guide_->reject(reason.toStdString());
    finish("Rejected: " + reason +
           (registered_ ? ".\nThe registration in use stays." : ".\nNo registration is in use."));
    Q_EMIT rejected(reason);
    Q_EMIT decided(entry);
  });
  return page;
}

void RegistrationPanel::setTheme(const Theme& theme) {
  theme_ = theme;
  cameras_->setTheme(theme);
  steps_->setTheme(theme);
  stop_->setTheme(theme);
  collect_->setTheme(theme);
  result_->setTheme(theme);
  poses_->setTheme(theme);
  history_->setTheme(theme);
}

void RegistrationPanel::setInUse(const Eigen::Isometry3d& base_from_camera) {
  registered_ = true;
  poses_->setCurrent(base_from_camera);
  history_->setCurrent(base_from_camera);
}

void RegistrationPanel::begin(const tracking::SourceInfo& source,
                              const std::optional<Eigen::Isometry3d>& in_use,
                              const std::optional<Eigen::Isometry3d>& nominal,
                              const vision::MarkerOptions& marker, const QString& poses_taken) {
  guide_ = std::make_unique<registration::RegistrationGuide>(source.robot, source.rig);
  guide_->start(in_use ? in_use : nominal);
  registered_ = in_use.has_value();
  cameras_->begin(source.rig, marker);
  stop_->setDrivable(source.live);
  result_->setRig(source.robot, source.rig);
  poses_->begin(source.robot, in_use, poses_taken);
  history_->setRobot(source.robot);
  close_->setText("Cancel");
  shown_ = RegistrationStep::kIdle;
  refresh();
}

void RegistrationPanel::leave() {
  if (guide_) guide_->leave();
  poses_->stop();
}

void RegistrationPanel::setEnded(bool ended) {
  if (ended == !ended_->isHidden()) return;
  ended_->setVisible(ended);
  stop_->setEnded(ended);
  collect_->setEnded(ended);
  result_->setEnded(ended);
  poses_->setEnded(ended);
  if (guide_ && guide_->step() == RegistrationStep::kDrive) stop_->showGuide(*guide_);
}

bool RegistrationPanel::active() const { return poses_->active() || guiding(); }

bool RegistrationPanel::guiding() const {
  return guide_ && guide_->step() != RegistrationStep::kIdle &&
         guide_->step() != RegistrationStep::kAccepted && guide_->step() != RegistrationStep::kRejected;
}

void RegistrationPanel::showSnapshot(const tracking::Snapshot& snapshot) {
  poses_->showSnapshot(snapshot);
  if (!guiding()) return;
  guide_->observe(snapshot);
  refresh();
}

void RegistrationPanel::showFrames(const cv::Mat& left, const cv::Mat& right,
                                   const tracking::Snapshot& snapshot) {
  if (active()) result_->showFrames(left, right, snapshot);
}

void RegistrationPanel::refresh() {
  if (!guide_) return;
  const auto step = guide_->step();
  const bool entered = step != shown_;
  shown_ = step;
  switch (step) {
    case RegistrationStep::kDrive:
      steps_->setStep(0);
      pages_->setCurrentWidget(stop_);
      return stop_->showGuide(*guide_);
    case RegistrationStep::kCollect:
    case RegistrationStep::kRefused:
      steps_->setStep(guide_->fault() == RegistrationFault::kNoRotation ? 0 : 1);
      pages_->setCurrentWidget(collect_);
      if (entered || points_shown_ != guide_->framesSeen() || step == RegistrationStep::kRefused)
        collect_->showGuide(*guide_);
      points_shown_ = guide_->framesSeen();
      return;
    case RegistrationStep::kReview:
      steps_->setStep(2);
      pages_->setCurrentWidget(result_);
      if (entered) result_->showGuide(*guide_);
      return;
    default:
      return;
  }
}

void RegistrationPanel::finish(const QString& message) {
  steps_->setStep(3);
  end_->setText(message);
  pages_->setCurrentWidget(end_);
  close_->setText("Close");
}

}  // namespace capstan::widgets
