// capstan-cli experiment, and the robot that track's filter assumes.
#include <gmock/gmock.h>

#include "tests/app/cli_fixture.h"
#include "tests/support/folders.h"
#include "tests/support/sample_poses.h"

namespace capstan::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kSmall =
    "name: small\nwork: track\nimages: false\ntrials:\n"
    "  - {name: free, trajectory: sinusoid, duration: 3, seed: 4}\n"
    "  - {name: half, trajectory: sinusoid, duration: 3, seed: 5, occlusion: {percentage: 50, interval: "
    "1}}\n";

TEST_F(Cli, AnExperimentLeavesItsPageTablesAndNumbers) {
  write("small.yaml", kSmall);
  const std::string command = "experiment " + path("small.yaml") + " --out " + path("out");
  const Ran first = run(command);
  ASSERT_EQ(first.exit, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("is simulated"));
  EXPECT_THAT(first.out, HasSubstr("RMS errors by trial"));
  EXPECT_THAT(first.out, HasSubstr("wall time"));
  for (const char* file : {"comparison.md", "results.json", "trials.tex", "means.csv", "boxplot.md",
                           "half-errors.csv", "free-trajectory.csv"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / "small" / file)) << file;

  const Ran again = run(command + " --json -");
  ASSERT_EQ(again.exit, 0) << again.err;
  const json numbers = json::parse(again.out)["experiments"]["small"]["trials"];
  write("six.yaml", "filter: six_state\n");
  const json tracked =
      json::parse(run("track --simulate --no-images --trajectory sinusoid --duration 3 --seed 4 --json - "
                      "--options " +
                      path("six.yaml"))
                      .out);
  ASSERT_EQ(numbers.size(), 2U);
  EXPECT_EQ(numbers[0]["rms"][0], tracked["rms"]["kin"]);
  EXPECT_EQ(numbers[0]["rms"][3], tracked["rms"]["ukf"]);
}

TEST_F(Cli, AnExperimentStopsAtCtrlCAndKeepsWhatIsDone) {
  std::string text =
      "name: long\nwork: track\nimages: false\ntrials:\n"
      "  - {name: first, trajectory: sinusoid, duration: 3}\n";
  write("long.yaml", text + "  - {name: endless, trajectory: sinusoid, duration: 2000}\n");
  const Ran stopped = interrupt("experiment " + path("long.yaml") + " --threads 2 --out " + path("out"),
                                path("out/long/trials/first.json"));
  EXPECT_EQ(stopped.exit, 1);
  EXPECT_THAT(stopped.err, HasSubstr("the same command goes on"));
  EXPECT_FALSE(fs::exists(folder_ / "out/long/results.json"));
}

TEST_F(Cli, AnExperimentThatIsNotKnownIsRefused) {
  const Ran unknown = run("experiment Z --out " + path("out"));
  EXPECT_EQ(unknown.exit, 2);
  EXPECT_THAT(unknown.err, HasSubstr("is not known"));
  write("bad.yaml", "name: bad\nwork: track\ntrials:\n  - {name: a, duration: long}\n");
  const Ran bad = run("experiment " + path("bad.yaml") + " --out " + path("out"));
  EXPECT_EQ(bad.exit, 2);
  EXPECT_THAT(bad.err, HasSubstr("bad.yaml:4: trials[0].duration = long"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

/// The nominal robot file with joint 1's effective pulley.
std::string believedRobot() {
  std::stringstream text;
  text << std::ifstream(test::resourceFile("robots/raven2_left.yaml")).rdbuf();
  std::string robot = text.str();
  const std::size_t at = robot.find("0.063095");
  EXPECT_NE(at, std::string::npos);
  return robot.replace(at, 8, "0.059000");
}

TEST_F(Cli, TheFilterMayBelieveInAnotherRobotThanThePlantIs) {
  write("believed.yaml", believedRobot());
  const std::string movement = "--no-images --trajectory sinusoid --duration 3";
  const std::string session = simulate("a.capstan", movement);
  const std::string believe = " --estimator-robot " + path("believed.yaml") + " --json -";
  const json nominal = json::parse(run("track " + session + " --json -").out);
  const Ran replayed = run("track " + session + believe);
  ASSERT_EQ(replayed.exit, 0) << replayed.err;
  const json believed = json::parse(replayed.out);
  const Ran live = run("track --simulate --seed 9 " + movement + believe);
  ASSERT_EQ(live.exit, 0) << live.err;

  EXPECT_EQ(json::parse(live.out)["rms"], believed["rms"]);  // one plant, one belief
  EXPECT_LT(believed["rms"]["kin"][0].get<double>(), 0.2 * nominal["rms"]["kin"][0].get<double>());
  EXPECT_LT(believed["rms"]["ukf"][0].get<double>(), nominal["rms"]["ukf"][0].get<double>());
  const Ran refused = run("track " + session + " --robot " + path("believed.yaml"));
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.err, HasSubstr("--estimator-robot"));
}

TEST_F(Cli, TheSecondPapersTableIsMadeOfAGivenTableOfPoses) {
  SamplePoses few;
  few.trajectories = 12;
  few.rows = 50;
  writeSamplePoses(path("poses.csv"), few);
  const std::string out = " --out " + path("out");
  const Ran none = run("experiment E" + out);
  EXPECT_EQ(none.exit, 2);
  EXPECT_THAT(none.err, HasSubstr("needs a table of tip poses"));
  const Ran ran = run("experiment E " + path("poses.csv") + " --splits 1 --inducing 60 --json -" + out);
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json clean = json::parse(ran.out)["clean"];
  for (const char* rigid : {"offset", "offset_cleaning"})
    EXPECT_LT(clean["gp_velocity_cleaning"]["distance"]["mean"], clean[rigid]["distance"]["mean"]) << rigid;
  for (const char* file : {"comparison.md", "numbers.json", "table-1-clean.tex", "table-1-all.csv",
                           "errors.pdf", "errors.svg", "errors.csv"})
    EXPECT_TRUE(fs::exists(folder_ / "out/E" / file)) << file;
  EXPECT_THAT(textOf("out/E/comparison.md"), HasSubstr("1.40 ± 1.70"))
      << "the paper's x, all parts of the method";
}

TEST_F(Cli, TheSecondPapersTrainingSizes) {
  writeSamplePoses(path("poses.csv"));
  const Ran ran = run("experiment F " + path("poses.csv") + " --inducing 60 --json - --out " + path("out"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json points = json::parse(ran.out)["points"];
  EXPECT_LT(points.back()["errors"]["distance"]["mean"], points.front()["errors"]["distance"]["mean"]);
  EXPECT_THAT(textOf("out/F/comparison.md"), HasSubstr("460 states"));
  EXPECT_TRUE(fs::exists(folder_ / "out/F/training-size.pdf"));
}

TEST_F(Cli, TheSecondPapersSimulatedExperiments) {
  const std::string small = " --motions 10 --inducing 20 --json - --out " + path("out");
  const Ran arrival = run("experiment G --arrivals 2" + small);
  ASSERT_EQ(arrival.exit, 0) << arrival.err;
  const json modes = json::parse(arrival.out)["arrival"];
  EXPECT_LT(modes["end_point"]["distance"]["mean"], modes["none"]["distance"]["mean"]);
  EXPECT_THAT(textOf("out/G/comparison.md"), HasSubstr("20.30 ± 0.80"));
  EXPECT_TRUE(fs::exists(folder_ / "out/G/arrival.pdf"));
  const Ran debridement = run("experiment H --fragments 2" + small);
  ASSERT_EQ(debridement.exit, 0) << debridement.err;
  EXPECT_EQ(json::parse(debridement.out)["methods"]["replanning"]["fragments"], 2);
  EXPECT_TRUE(fs::exists(folder_ / "out/H/debridement.svg"));
  EXPECT_EQ(run("experiment G " + path("poses.csv") + small).exit, 2) << "it simulates";
}

}  // namespace
}  // namespace capstan::testing
