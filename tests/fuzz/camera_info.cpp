#include "tests/fuzz/rig_laws.h"

/// ROS camera_info: the texts of the left and the right file.
CAPSTAN_FUZZ_TARGET(camera_info) {
  using namespace capstan;
  const auto parts = fuzz::partsOf(bytes, 2);
  fuzz::allowInputError([&] {
    const vision::StereoRig rig = vision::parseStereoRig(parts[0], parts[1]);
    fuzz::requireRig(rig);
  });
}
