#pragma once

#include "core/identification/camera_pose.h"
#include "core/identification/parameters.h"

namespace capstan::identification {

/// What a user may know better than the defaults, as a file. resources/identification/default.yaml holds the
/// defaults.
struct IdentificationOptions {
  ParameterOptions parameters;
  CameraPoseOptions camera;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.parameters, {"parameters", "", "priors, bounds and goals", {}, false});
    field(self.camera, {"camera", "", "how far registration and clock may be off", {}, false});
  }
};

}  // namespace capstan::identification
