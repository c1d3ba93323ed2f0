#include "widgets/shell/analysis_controller.h"

#include <fmt/format.h>
#include <QAction>
#include <QStackedWidget>

#include <algorithm>
#include <optional>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/errors/errors_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {
namespace {

/// What the errors of a pipeline assume, as live::Runner restarts its report for: robot, registration, filter
/// options and cameras.
struct Assumptions {
  std::string robot, options;
  std::optional<Eigen::Isometry3d> registration;
  double baseline = 0.0;

  static Assumptions of(const tracking::TrackingPipeline& pipeline) {
    return {robot::formatDescription(pipeline.robot()), base::writeYaml(pipeline.options()),
            pipeline.registration(), pipeline.rig() ? pipeline.rig()->baseline() : 0.0};
  }
  bool operator==(const Assumptions& other) const {
    const bool same = registration && other.registration ? registration->isApprox(*other.registration)
                                                         : !registration && !other.registration;
    return same && robot == other.robot && options == other.options && baseline == other.baseline;
  }
};

}  // namespace

AnalysisController::AnalysisController(AnalysisPanel& panel, QStackedWidget& centre, SessionLink& link,
                                       SessionBar& bar, ErrorsPanel& errors, NotesPanel& notes,
                                       QObject* parent)
    : QObject(parent), panel_(panel), link_(link) {
  addAction(centre, bar);
  gather();
  panel_.setSession([this] { return withErrors(); });
  connect(&errors, &ErrorsPanel::resetRequested, this, [this] { gathered_->restart(); });
  connect(&panel, &AnalysisPanel::exported, this,
          [this, &notes](const QString& base) { notes.addFile(now_, "export", base); });
}

void AnalysisController::addAction(QStackedWidget& centre, SessionBar& bar) {
  auto* action = new QAction(tr("Analyse"), this);
  action->setObjectName("analyse");
  action->setCheckable(true);
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+L")));
  action->setToolTip(tr(
      "Show histogram, box plot and comparison of runs instead of the plots, or the plots again (Ctrl+L)"));
  bar.addPanelAction(action);
  connect(action, &QAction::toggled, &centre, [this, &centre](bool shown) {
    centre.setCurrentIndex(shown ? 1 : 0);
    if (shown) panel_.setFocus();
  });
}

/// Called on the pipeline's thread. A change of the assumptions restarts the errors, as in the errors table.
void AnalysisController::gather() {
  connect(&link_, &SessionLink::opened, this,
          [this](const tracking::SourceInfo& info, const SourceChoice& choice) {
            files_.clear();
            if (choice.isRecording()) noteFile(choice.file);
            gathered_ = std::make_shared<Gathered>();
            now_ = info.begin;
            std::array<QString, 3> names;
            for (std::size_t i = 0; i < names.size() && i < info.robot.joints.size(); ++i)
              names[i] = QString::fromStdString(info.robot.joints[i].name);
            panel_.setJointNames(names);
            const auto before = std::make_shared<std::optional<Assumptions>>();
            link_.listen(
                this, {[gathered = gathered_, before](const tracking::TrackingPipeline& pipeline) {
                         auto now = Assumptions::of(pipeline);
                         if (*before && !(now == **before)) gathered->restart();
                         *before = std::move(now);
                       },
                       [gathered = gathered_](const tracking::Sample&, const tracking::Snapshot& snapshot) {
                         gathered->errors.take(snapshot);
                         gathered->motion.take(snapshot);
                       }});
            panel_.sessionOpened();
          });
  connect(&link_, &SessionLink::status, this, [this](const live::RunStatus& status) {
    now_ = status.t;
    noteFile(QString::fromStdString(status.recording));
  });
}

void AnalysisController::noteFile(const QString& file) {
  const std::filesystem::path path = file.toStdString();
  if (!path.empty() && std::find(files_.begin(), files_.end(), path) == files_.end()) files_.push_back(path);
}

analysis::ErrorRun AnalysisController::withErrors() const {
  analysis::ErrorRun run = soFar();
  if (!run.errors.empty()) return run;
  const tracking::SourceInfo& info = link_.runner()->info();
  const bool ever = info.reference || info.own_kinematics;
  throw base::InputError({info.title,
                          0,
                          {},
                          {},
                          ever ? "has no errors yet" : "has no joint encoders, so its errors are not known",
                          ever ? "Let it run, then Refresh (F5)" : "Choose a recording with a reference"});
}

analysis::ErrorRun AnalysisController::soFar() const {
  if (!link_.runner())
    throw base::InputError({"this session", 0, {}, {}, "is not open", "Open a source first"});
  const tracking::SourceInfo& info = link_.runner()->info();
  analysis::ErrorRun run = gathered_->errors.run();
  run.trajectory = gathered_->motion.trajectory();
  run.title = info.title;
  run.motion = "session " + info.title;
  run.files = files_;
  run.filter_robot = link_.runner()->robot().name;
  if (robot::formatDescription(link_.runner()->robot()) != robot::formatDescription(info.robot))
    run.filter_robot += ", changed in this session";
  run.kinematic_robot = run.filter_robot;
  run.own_kinematics = info.own_kinematics;
  run.simulated = !info.truth.empty();
  const auto report = link_.runner()->report();
  if (report.since != tracking::ReportStart::kBeginning)
    run.notices.push_back(fmt::format("since {}, at {:.1f} s", base::nameOf(report.since), report.first_t));
  if (info.own_kinematics)
    run.notices.push_back("its reference is the robot's own kinematics: these are differences, not errors");
  return run;
}

}  // namespace capstan::widgets
