#include "app/cli/pose_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "app/cli/console.h"
#include "core/base/checksum.h"
#include "core/base/same_recording.h"
#include "core/recording/pose_table.h"

namespace capstan::cli {

std::vector<learning::RawMotion> readMotions(const std::vector<std::string>& files) {
  std::vector<learning::RawMotion> all;
  for (const std::string& file : files) {
    std::vector<learning::RawMotion> motions = recording::readPoseTable(file);
    if (files.size() > 1)
      for (learning::RawMotion& motion : motions) motion.name = file + ", " + motion.name;
    all.insert(all.end(), std::make_move_iterator(motions.begin()), std::make_move_iterator(motions.end()));
  }
  return all;
}

void checkProcesses(const learning::CorrectionModel& model, const std::string& file) {
  if (model.processes().empty())
    refuseFile(file, "is a rigid offset alone, which neither ages nor takes anything in",
               "Learn Gaussian processes from all tables");
}

void checkDistinct(const std::vector<std::string>& files) {
  for (std::size_t a = 0; a < files.size(); ++a)
    for (std::size_t b = a + 1; b < files.size(); ++b)
      if (base::sameRecording(files[a], files[b]))
        refuseFile(files[b], "is given twice: its motions would count twice", "Give each table once");
}

void checkNew(const std::vector<std::string>& files, const learning::CorrectionSource& source) {
  for (const std::string& file : files)
    if (std::ranges::count(source.checksums, base::checksumOfFile(file)) > 0)
      refuseFile(file, "has been learned from already", "Give motions that are new to the model");
}

void checkNear(const learning::CorrectionModel& model, const std::vector<learning::State>& states,
               const std::string& file) {
  constexpr double kNear = 1.0;  // [m]
  double nearest = std::numeric_limits<double>::infinity();
  for (const learning::State& state : states)
    nearest = std::min(nearest,
                       model.workspace().exteriorDistance((model.offset() * state.pair.seen).translation()));
  if (model.workspace().isEmpty() || nearest <= kNear) return;
  refuseFile(file,
             fmt::format("has no pose within {} m of what was learned: the nearest is {:.3g} m away", kNear,
                         nearest),
             "Give positions in metres, in the frame of the cameras");
}

}  // namespace capstan::cli
