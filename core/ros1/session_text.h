#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "core/base/field.h"
#include "core/tracking/source.h"

namespace capstan::ros1 {

/// What a session knows beside its samples, as the YAML text of the message on kSessionTopic.
struct SessionText {
  std::string title, robot, truth, marker, tracking;
  bool own_kinematics = false;
  int epoch = 0;  ///< ROS time of the session's time 0 [s]; 0: samples were received by another program
  double begin = 0.0, duration = 0.0;
  std::optional<Eigen::Matrix4d> base_from_camera;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.title, {"title", "", "name of the session"});
    field(self.robot, {"robot", "", "text of the robot file"});
    field(self.truth, {"truth", "", "text of a simulation's truth file", {}, false});
    field(self.marker, {"marker", "", "text of the marker options", {}, false});
    field(self.tracking, {"tracking", "", "text of the filter options", {}, false});
    field(self.own_kinematics,
          {"own_kinematics", "", "whether joints are computed by the robot from its motors", {}, false});
    field(self.epoch, {"epoch", "s", "ROS time of the session's time 0; 0: not kept", {0.0, 2147483647.0}});
    field(self.begin, {"begin", "s", "time of the first sample", {}, false});
    field(self.duration, {"duration", "s", "time from the first to the last sample", {}, false});
    field(self.base_from_camera, {"base_from_camera", "", "registration, 4 x 4", {}, false});
  }
};

/// The text of a source's facts, and the facts of a text. Throws base::InputError with line and key.
std::string formatSessionText(const tracking::SourceInfo& info, int epoch);
SessionText parseSessionText(const std::string& text, const std::string& file);
/// Takes the facts of `text` into `info`.
void takeSessionText(const SessionText& text, const std::string& file, tracking::SourceInfo& info);

}  // namespace capstan::ros1
