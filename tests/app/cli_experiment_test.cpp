// capstan-cli experiment, and the robot that track's filter believes in.
#include <gmock/gmock.h>

#include "tests/app/cli_fixture.h"

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
  text << std::ifstream(CAPSTAN_RESOURCES "/robots/raven2_left.yaml").rdbuf();
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

}  // namespace
}  // namespace capstan::testing
