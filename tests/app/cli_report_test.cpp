// The report's three rows: nominal constants, what identification found, the same recording tracked again.
#include "tests/app/cli_fixture.h"

namespace capstan {
namespace {

using testing::Cli;
using testing::json;
using testing::Ran;

TEST_F(Cli, ReportTracksAgainWithWhatItIdentified) {
  const Ran made = run("report --duration 15 --no-images --json - --out " + path("r"));
  ASSERT_EQ(made.exit, 0) << made.err;
  const json report = json::parse(made.out);
  ASSERT_TRUE(report.contains("identified")) << "tracked with nominal constants, and no more";
  const json& after = report["identified"];
  EXPECT_EQ(after["fault"], "");
  // The pulley of the plant is not the robot file's: the estimator's health says so, and what to do.
  EXPECT_EQ(report["health"]["verdict"], "cautious");
  for (const json& check : report["health"]["checks"]) {
    EXPECT_EQ(check["advice"] != "", check["verdict"] != "pass" && check["verdict"] != "unknown")
        << check["key"];
    if (check["key"] != "transmission") continue;
    EXPECT_EQ(check["verdict"], "cautious");
    EXPECT_NE(check["value"].get<std::string>().find("pulley radius"), std::string::npos);
  }
  EXPECT_NE(textOf("r/index.html").find("Estimator health: cautious"), std::string::npos);

  // The oracle: identify and track, each on the recording that the report left.
  const std::string session = path("r/session.capstan"), robot = path("robot.yaml");
  const Ran found = run("identify " + session + " --out " + robot + " --json -");
  ASSERT_EQ(found.exit, 0) << found.err;
  const json batch = json::parse(found.out)["batch"]["parameters"];
  ASSERT_EQ(after["parameters"].size(), batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const json &ours = after["parameters"][i], &theirs = batch[i];
    EXPECT_EQ(ours["name"], theirs["name"]);
    EXPECT_EQ(ours["seen"], theirs["seen"]) << ours["name"];
    EXPECT_NEAR(ours["value"].get<double>() / theirs["value"].get<double>(), 1.0, 1e-6) << ours["name"];
    EXPECT_NEAR(ours["sigma"].get<double>() / theirs["sigma"].get<double>(), 1.0, 1e-6) << ours["name"];
  }
  const json again = json::parse(run("track " + session + " --estimator-robot " + robot + " --json -").out);
  for (const char* estimator : {"kin", "cam", "ukf"})
    for (std::size_t joint = 0; joint < 3; ++joint)
      EXPECT_NEAR(after["tracked"]["rms"][estimator][joint].get<double>(),
                  again["rms"][estimator][joint].get<double>(), 1e-9)
          << estimator << joint;
  EXPECT_NEAR(after["tracked"]["nis"].get<double>(), again["nis"].get<double>(), 1e-6);
  // The pulley of the plant is not the robot file's: the second time is the better one.
  EXPECT_LT(after["tracked"]["rms"]["kin"][0].get<double>(), 0.2 * report["rms"]["kin"][0].get<double>());
  EXPECT_LT(after["tracked"]["rms"]["ukf"][0].get<double>(), report["rms"]["ukf"][0].get<double>());
}

TEST_F(Cli, ReportSaysItsThreeRowsInWords) {
  const Ran made = run("report --duration 15 --no-images --out " + path("r"));
  ASSERT_EQ(made.exit, 0) << made.err;
  const std::string page = textOf("r/index.html");
  for (const char* words : {"1 nominal", "2 identified", "3 tracked again", "r_l1 59.", "NIS / 3 is",
                            "of motors and cameras alone", "The filter is "}) {
    EXPECT_NE(made.out.find(words), std::string::npos) << words << '\n' << made.out;
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
}

TEST_F(Cli, ReportWithoutCamerasSaysWhyNothingWasIdentified) {
  for (const std::string without : {"--no-cameras", "--unregistered"}) {
    const Ran made = run("report --duration 2 --trajectory sinusoid " + without + " --out " + path("r"));
    ASSERT_EQ(made.exit, 0) << made.err;
    EXPECT_NE(made.out.find("1 nominal"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("Nothing could be identified: the cameras"), std::string::npos) << made.out;
    EXPECT_EQ(made.out.find("3 tracked again"), std::string::npos) << made.out;
  }
}

}  // namespace
}  // namespace capstan
