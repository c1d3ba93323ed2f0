#include <cmath>

#include "core/recording/recover.h"
#include "core/recording/session_file.h"
#include "core/recording/session_images.h"
#include "core/recording/session_source.h"
#include "tests/fuzz/fuzz_target.h"

/// A session that SQLite opens: everything in it is read.
CAPSTAN_FUZZ_TARGET(session) {
  using namespace capstan;
  fuzz::emptyFolder();
  const std::filesystem::path file = fuzz::fileOf(bytes, "trial.capstan");
  fuzz::allowInputError([&] { recording::readSessionSummary(file); });
  fuzz::allowInputError([&] { recording::readSessionEvents(file); });
  fuzz::allowInputError([&] { recording::readSessionEstimates(file); });
  fuzz::allowInputError([&] {
    recording::SessionSource source(file);
    tracking::Sample sample;
    while (source.next(sample)) {
    }
  });
  fuzz::allowInputError([&] {
    recording::SessionImages images(file);
    tracking::StereoFrame frame;
    images.at(0.1, 10.0, frame);
  });
  recording::faultOf(file);
}
