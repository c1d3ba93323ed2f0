#include "core/recording/pose_table.h"
#include "core/learning/poses/screen_poses.h"
#include "tests/fuzz/fuzz_target.h"

CAPSTAN_FUZZ_TARGET(pose_table) {
  using namespace capstan;
  fuzz::allowInputError([&] {
    const auto motions = recording::parsePoseTable(bytes, "poses.csv");
    fuzz::require(!motions.empty(), "a table has a motion");
    for (const learning::PoseMotion& motion : learning::screenPoses(motions).motions)
      for (const auto& stream : motion.streams)
        for (std::size_t i = 0; i < stream.size(); ++i) {
          fuzz::require(stream[i].pose.matrix().allFinite(), "poses are finite");
          fuzz::require(i == 0 || stream[i].t > stream[i - 1].t, "times rise");
        }
  });
  fuzz::allowInputError(
      [&] { recording::parseTipTable(table_files::columnsOfCsv(bytes, "tips.csv"), "tips.csv"); });
}
