#include "widgets/shell/robot_controller.h"

#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

RobotController::RobotController(SessionLink& link, StatusLine& status, NotesPanel& notes, QObject* parent)
    : QObject(parent), link_(link), status_(status), notes_(notes) {
  connect(&link, &SessionLink::robotChanged, this, [this] { show(link_.runner()->info()); });
  connect(&link, &SessionLink::opened, this, [this](const tracking::SourceInfo& info) {
    show(info);
    report(info);
  });
}

void RobotController::show(const tracking::SourceInfo& info) {
  const RobotChoice& robots = link_.robots();
  const bool chosen = robots.robotFor(info) || robots.isOwnOf(info);
  status_.setRobot(robots.words(info), chosen ? robots.summary() : QString());
}

void RobotController::report(const tracking::SourceInfo& info) {
  const RobotChoice& robots = link_.robots();
  if (robots.robotFor(info))
    notes_.addEvent(info.begin, "robot",
                    tr("%1: stays in use; Undo under Identification restores the robot file (%2)")
                        .arg(robots.words(info), robots.summary()));
  else if (robots.isOwnOf(info))
    notes_.addEvent(info.begin, "robot",
                    tr("%1, the source's own (%2)").arg(robots.words(info), robots.summary()));
  else if (robots.any())
    notes_.addEvent(info.begin, "robot",
                    tr("%1, the source's own; the robot chosen before belongs to another robot or truth file")
                        .arg(robots.words(info)));
}

}  // namespace capstan::widgets
