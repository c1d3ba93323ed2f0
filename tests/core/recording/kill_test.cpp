// What was older than half a second is in the file, whenever the recording process dies.
#include <gtest/gtest.h>

#include "tests/core/recording/recording_child.h"

namespace capstan::recording {
namespace {

TEST(Kill, EveryFileOpensAndNothingOlderThanHalfASecondIsLost) {
  base::Random random(7);
  for (int i = 0; i < 3; ++i) {
    const testing::TemporaryFolder folder;
    const double seconds = random.uniform(0.6, 1.3);
    const auto outcome = testing::recordAndKill(folder / "a.capstan", seconds);
    EXPECT_TRUE(outcome.opened) << outcome.error;
    EXPECT_TRUE(outcome.intact) << outcome.error;
    EXPECT_EQ(outcome.lost_late, 0U) << "oldest lost: " << outcome.oldest_lost << " s";
    EXPECT_GT(outcome.offered, static_cast<unsigned>(1000.0 * seconds));
  }
}

}  // namespace
}  // namespace capstan::recording
