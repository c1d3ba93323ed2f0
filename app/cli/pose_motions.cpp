#include "app/cli/pose_motions.h"

#include <iterator>

#include "app/cli/console.h"
#include "core/experiments/same_recording.h"
#include "core/learning/learn.h"
#include "core/session/pose_table.h"

namespace capstan::cli {

std::vector<learning::RawMotion> readMotions(const std::vector<std::string>& files,
                                             learning::StreamKind towards) {
  std::vector<learning::RawMotion> all;
  for (const std::string& file : files) {
    std::vector<learning::RawMotion> motions = session::readPoseTable(file);
    session::namingTables({file}, [&] { learning::checkTable(motions, towards); });
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
      if (experiments::sameRecording(files[a], files[b]))
        refuseFile(files[b], "is given twice: its motions would count twice", "Give each table once");
}

}  // namespace capstan::cli
