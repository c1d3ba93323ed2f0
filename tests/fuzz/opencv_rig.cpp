#include "core/vision/rig_file.h"
#include "tests/fuzz/rig_laws.h"

/// The text is read as YAML, XML or JSON, as it begins.
CAPSTAN_FUZZ_TARGET(opencv_rig) {
  using namespace capstan;
  const char* name = bytes.starts_with("<") ? "rig.xml" : bytes.starts_with("{") ? "rig.json" : "rig.yml";
  fuzz::allowInputError([&] { fuzz::requireRig(vision::readOpenCvRig(fuzz::fileOf(bytes, name))); });
}
