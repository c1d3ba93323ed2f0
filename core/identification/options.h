#pragma once

#include "core/identification/camera_pose.h"
#include "core/identification/parameters.h"

namespace capstan::identification {

/// Options of identification that a user may set in a file. resources/identification/default.yaml contains
/// the defaults.
struct IdentificationOptions {
  ParameterOptions parameters;
  CameraPoseOptions camera;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.parameters, {"parameters", "", "priors, bounds and goals", {}, false});
    field(self.camera, {"camera", "", "priors of registration and clock errors", {}, false});
  }
};

}  // namespace capstan::identification
