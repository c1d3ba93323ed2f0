/// What the window's command line opens.
#include <gtest/gtest.h>

#include "app/workstation/arguments.h"

namespace capstan::workstation {
namespace {

widgets::SourceChoice lastTable() { return widgets::SourceChoice::ofFile("/data/last.csv"); }

widgets::SourceChoice opened(const std::string& line) {
  Arguments arguments;
  CLI::App cli;
  addOptions(cli, arguments);
  cli.parse(line);
  imply(cli, arguments);
  return choiceOf(arguments, lastTable());
}

TEST(WindowArguments, NothingAskedOpensWhatWasOpenLast) { EXPECT_EQ(opened("").file, lastTable().file); }

TEST(WindowArguments, EachOptionOfTheSimulationAsksForOne) {
  EXPECT_TRUE(opened("--simulate").simulated);
  EXPECT_TRUE(opened("--unregistered").simulated);
  EXPECT_FALSE(opened("--unregistered").simulation.registered);
  EXPECT_TRUE(opened("--distractors").simulation.distractors);
  EXPECT_EQ(opened("--seed 7").simulation.seed, 7U);
  for (const char* alone : {"--distractors", "--uneven-light", "--seed 7", "--truth matched",
                            "--trajectory hold", "--robot arm.yaml", "--screenshot a.png"})
    EXPECT_TRUE(opened(alone).simulated) << alone;
  EXPECT_EQ(opened("--robot arm.yaml").simulation.robot, "arm.yaml");
}

TEST(WindowArguments, ARobotForATableStaysWithTheTable) {
  const auto choice = opened("--table a.csv --robot arm.yaml");
  EXPECT_FALSE(choice.simulated);
  EXPECT_EQ(choice.robot, "arm.yaml");
}

TEST(WindowArguments, WhatWouldBeIgnoredIsRefused) {
  for (const char* wrong :
       {"--unregistered --session a.capstan", "--simulate --table b.csv", "--seed 3 --table b.csv",
        "--session a.capstan --table b.csv", "--state paused", "--after 5"})
    EXPECT_THROW(opened(wrong), CLI::ParseError) << wrong;
}

}  // namespace
}  // namespace capstan::workstation
