/// Strangers at the port of a live motor side; tests/benchmarks/stream_study sends more of them.
#include <gtest/gtest.h>

#include "tests/support/attacked_side.h"

namespace capstan::testing {
namespace {

TEST(MutatedStreams, AreCountedNamedAndFollowedByTheRobot) {
  base::Random random(2, "mutated streams");
  AttackedSide side;
  for (std::size_t k = 0; k < 10 * mutationKinds().size(); ++k) side.send(mutatedStream(k, random));
  for (const std::string& failure : side.failures()) ADD_FAILURE() << failure;
  for (const auto& [kind, counts] : side.counts())
    EXPECT_GT(counts.refused + counts.steps, 0U)
        << kind << ": a mutation that is never noticed mutates nothing";
}

}  // namespace
}  // namespace capstan::testing
