#include "widgets/shell/robot_choice.h"

#include <QObject>

namespace capstan::widgets {

namespace {

std::string armOf(const tracking::SourceInfo& source) {
  return robot::formatDescription(source.robot) + source.truth;
}

}  // namespace

void RobotChoice::choose(const tracking::SourceInfo& source, const robot::Description& robot,
                         const RobotWords& words) {
  if (robot::formatDescription(robot) == robot::formatDescription(source.robot))
    chosen_.reset();
  else
    chosen_ = {armOf(source), robot, words};
}

const robot::Description* RobotChoice::robotFor(const tracking::SourceInfo& source) const {
  return chosen_ && chosen_->arm == armOf(source) ? &chosen_->robot : nullptr;
}

bool RobotChoice::isOwnOf(const tracking::SourceInfo& source) const {
  return chosen_ && robot::formatDescription(chosen_->robot) == robot::formatDescription(source.robot);
}

QString RobotChoice::words(const tracking::SourceInfo& source) const {
  const QString name = QString::fromStdString(source.robot.name);
  const bool chosen = robotFor(source) || isOwnOf(source);
  return chosen ? QStringLiteral("%1, %2").arg(name, chosen_->words.word) : name;
}

}  // namespace capstan::widgets
