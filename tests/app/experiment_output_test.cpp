// What the experiment command says of a run that was stopped.
#include "app/cli/experiment_output.h"

#include <gtest/gtest.h>

namespace capstan::cli {
namespace {

experiments::Results kept(int trials) {
  experiments::Results results;
  results.kept = trials;
  return results;
}

TEST(ExperimentOutput, OnlyWhatIsKeptIsSaidToBeKept) {
  EXPECT_EQ(cancelledText({kept(0)}, "out"),
            "cancelled before the first trial was finished: nothing is kept");
  EXPECT_EQ(cancelledText({kept(0), kept(1)}, "out"),
            "cancelled: 1 finished trial is kept in out; the same command goes on from there");
  EXPECT_EQ(cancelledText({kept(2), kept(1)}, "out"),
            "cancelled: 3 finished trials are kept in out; the same command goes on from there");
}

TEST(ExperimentOutput, OneTrialIsNoTrials) {
  experiments::Results results;
  results.name = "one";
  results.trials.resize(1);
  EXPECT_NE(timesText({results}, 1.0).find("one          1 trial,"), std::string::npos);
  results.trials.resize(2);
  EXPECT_NE(timesText({results}, 1.0).find("one          2 trials,"), std::string::npos);
}

}  // namespace
}  // namespace capstan::cli
