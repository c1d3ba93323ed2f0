#include "app/cli/pose_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/cli/console.h"
#include "core/base/checksum.h"

namespace capstan::cli {

void checkProcesses(const learning::CorrectionModel& model, const std::string& file) {
  if (model.processes().empty())
    refuseFile(file, "is a rigid offset alone, which can neither drift nor learn",
               "Learn Gaussian processes from all tables");
}

void checkNew(const std::vector<std::string>& files, const learning::CorrectionSource& source) {
  for (const std::string& file : files)
    if (std::ranges::count(source.checksums, base::checksumOfFile(file)) > 0)
      refuseFile(file, "is already part of the training", "Give motions that are new to the model");
}

void checkNear(const learning::CorrectionModel& model, const std::vector<learning::State>& states,
               const std::string& file) {
  constexpr double kNear = 1.0;  // [m]
  double nearest = std::numeric_limits<double>::infinity();
  for (const learning::State& state : states)
    nearest = std::min(
        nearest, model.workspace().exteriorDistance((model.offset() * state.pair.observed).translation()));
  if (model.workspace().isEmpty() || nearest <= kNear) return;
  refuseFile(file,
             fmt::format("has no pose within {} m of the learned poses: the nearest is {:.3g} m away", kNear,
                         nearest),
             "Give positions in metres, in the frame of the cameras");
}

}  // namespace capstan::cli
