#include "core/ros1/session_text.h"

#include "core/base/error.h"
#include "core/base/rigid.h"
#include "core/base/yaml.h"

namespace capstan::ros1 {

std::string formatSessionText(const tracking::SourceInfo& info, int epoch) {
  SessionText text{.title = info.title,
                   .robot = base::writeYaml(info.robot),
                   .truth = info.truth,
                   .marker = info.marker,
                   .tracking = info.tracking,
                   .own_kinematics = info.own_kinematics,
                   .epoch = epoch,
                   .begin = info.begin,
                   .duration = info.duration,
                   .base_from_camera = {}};
  if (info.base_from_camera) text.base_from_camera = info.base_from_camera->matrix();
  return base::writeYaml(text);
}

SessionText parseSessionText(const std::string& text, const std::string& file) {
  return base::readYaml<SessionText>(text, file);
}

void takeSessionText(const SessionText& text, const std::string& file, tracking::SourceInfo& info) {
  info.title = text.title;
  info.robot = robot::parseDescription(text.robot, file + " (robot)");
  info.truth = text.truth, info.marker = text.marker, info.tracking = text.tracking;
  info.own_kinematics = text.own_kinematics;
  info.begin = text.begin, info.duration = text.duration;
  if (text.base_from_camera && !base::isRigid(*text.base_from_camera))
    throw base::InputError({file,
                            0,
                            "base_from_camera",
                            {},
                            "is no rigid transform",
                            "Export the session again, or register again"});
  if (text.base_from_camera) info.base_from_camera = Eigen::Isometry3d(*text.base_from_camera);
}

}  // namespace capstan::ros1
