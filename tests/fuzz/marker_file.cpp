#include "core/vision/marker_file.h"
#include "tests/fuzz/fuzz_target.h"

CAPSTAN_FUZZ_TARGET(marker_file) {
  using namespace capstan;
  fuzz::allowInputError([&] { vision::readMarkerFile(fuzz::fileOf(bytes, "marker.yaml")); });
}
