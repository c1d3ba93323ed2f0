#include "core/recording/recover.h"

#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "core/recording/session_file.h"
#include "tests/fuzz/fuzz_target.h"

/// Recovery of a damaged session; what was recovered is a whole session.
CAPSTAN_FUZZ_TARGET(recover) {
  using namespace capstan;
  static const std::string robot = base::readTextFile(base::resource("robots/raven2_left.yaml"));
  const std::filesystem::path folder = fuzz::emptyFolder();
  const auto parts = fuzz::partsOf(bytes, 2);  // the file and the log beside it
  const std::filesystem::path file = fuzz::fileOf(parts[0], "trial.capstan");
  if (!parts[1].empty()) fuzz::fileOf(parts[1], "trial.capstan-wal");
  fuzz::allowInputError([&] {
    const auto to = folder / "recovered.capstan";
    const recording::Recovery recovery = recording::recoverSession(file, to, {robot});
    fuzz::require(recovery.lost_rows >= 0, "numbers of rows are not negative");
    for (const recording::LostRows& lost : recovery.lost)
      fuzz::require(lost.count > 0, "lost rows are counted");
    if (recovery.saved() == 0) return;
    fuzz::require(recording::faultOf(to).empty(), "a recovered session is whole");
  });
}
