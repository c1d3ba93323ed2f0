#include "widgets/shell/occlusion_controller.h"

#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

OcclusionController::OcclusionController(OcclusionPanel& panel, SessionLink& link, NotesPanel& notes,
                                         QObject* parent)
    : QObject(parent), panel_(panel), link_(link), notes_(notes) {
  connect(&link, &SessionLink::snapshot, this, [this](const tracking::Snapshot& s) {
    now_ = s.t;
    // Tip positions without images are recognized only when the first sample arrives.
    if (s.camera_samples > 0 && !panel_.isEnabled()) take(true);
  });
  connect(&panel, &OcclusionPanel::blockChanged, this, [this](bool left, bool right) {
    if (!link_.runner()) return;
    link_.runner()->block(left, right);
    note(left && right ? tr("both cameras blocked")
         : left        ? tr("left camera blocked")
         : right       ? tr("right camera blocked")
                       : tr("cameras free"));
  });
  connect(&panel, &OcclusionPanel::scheduleChanged, this, [this](const live::OcclusionSchedule& schedule) {
    if (!link_.runner()) return;
    link_.runner()->setOcclusion(schedule);
    note(QString::fromStdString(live::scheduleWords(schedule)));
  });
}

void OcclusionController::begin(const tracking::SourceInfo& info) {
  now_ = info.begin;
  panel_.beginSession(info.begin, link_.again());
  const live::OcclusionSchedule& schedule = panel_.schedule();
  if (schedule.percentage > 0.0)
    note(tr("still %1").arg(QString::fromStdString(live::scheduleWords(schedule))));
  take(info.rig.has_value());
}

/// Applies the panel's blocks and schedule if the source can be blocked; otherwise nothing is blocked.
void OcclusionController::take(bool blockable) {
  panel_.setBlockable(blockable);
  link_.runner()->setOcclusion(blockable ? panel_.schedule() : live::OcclusionSchedule{});
  link_.runner()->block(blockable && panel_.blocked()[0], blockable && panel_.blocked()[1]);
}

/// Adds a note. For a recording, it says that the user's occlusion was added to the recorded one.
void OcclusionController::note(const QString& what) {
  notes_.addEvent(now_, "occlusion",
                  link_.runner()->info().live ? what : tr("%1, added to the recording").arg(what));
}

}  // namespace capstan::widgets
