#include "app/cli/pose_motions.h"

#include <iterator>

#include "core/session/pose_table.h"

namespace capstan::cli {

std::vector<learning::RawMotion> readMotions(const std::vector<std::string>& files) {
  std::vector<learning::RawMotion> all;
  for (const std::string& file : files) {
    std::vector<learning::RawMotion> motions = session::readPoseTable(file);
    if (files.size() > 1)
      for (learning::RawMotion& motion : motions) motion.name = file + ", " + motion.name;
    all.insert(all.end(), std::make_move_iterator(motions.begin()), std::make_move_iterator(motions.end()));
  }
  return all;
}

}  // namespace capstan::cli
