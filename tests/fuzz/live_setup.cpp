#include "core/live/live_setup.h"
#include "tests/fuzz/fuzz_target.h"

CAPSTAN_FUZZ_TARGET(live_setup) {
  using namespace capstan;
  fuzz::allowInputError([&] {
    const live::LiveSetup setup = live::readLiveSetup(fuzz::fileOf(bytes, "live.yaml"));
    live::writeLiveSetup(setup, fuzz::fileOf({}, "again.yaml"));
  });
}
