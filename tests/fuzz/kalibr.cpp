#include "core/vision/rig_file.h"
#include "tests/fuzz/rig_laws.h"

CAPSTAN_FUZZ_TARGET(kalibr) {
  using namespace capstan;
  fuzz::allowInputError([&] { fuzz::requireRig(vision::readKalibr(fuzz::fileOf(bytes, "camchain.yaml"))); });
}
