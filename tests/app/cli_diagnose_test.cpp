#include "core/base/resource.h"
#include "tests/app/cli_fixture.h"
#include "tests/app/diagnose_recording.h"

namespace capstan::testing {
namespace {

/// A recording of one short motion, whose elbow has play.
class CliDiagnose : public Cli {
 protected:
  CliDiagnose() { writeRecording(path("slow.csv"), {.duration = 12.0}); }
};

TEST_F(CliDiagnose, AnswersWithAVerdictAndWritesAllThatIsAskedFor) {
  const Ran ran = run("diagnose " + path("slow.csv") +
                      " --only backlash,capstan_eccentricity --no-filter --json - --out " +
                      path("robot.yaml") + " --report " + path("page"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json document = json::parse(ran.out);
  const std::string verdict = document.at("verdict");
  EXPECT_NE(std::string("found several tie nothing unexplained").find(verdict), std::string::npos) << verdict;
  for (const json& cause : document.at("causes"))
    EXPECT_TRUE(cause.at("effect") == "backlash" || cause.at("effect") == "capstan_eccentricity");
  for (const json& candidate : document.at("candidates"))
    EXPECT_TRUE(candidate.at("effect") == "backlash" || candidate.at("effect") == "capstan_eccentricity");
  EXPECT_TRUE(document.at("refit").is_object());
  EXPECT_EQ(document.at("channels").size(), 3U);
  EXPECT_TRUE(document.at("filter").empty());
  EXPECT_EQ(textOf("robot.yaml").rfind("# Extended by a diagnosis of slow.csv", 0), 0U);
  EXPECT_TRUE(fs::exists(path("page/index.html")));
  EXPECT_EQ(json::parse(textOf("page/report.json")).at("verdict"), verdict);
  EXPECT_EQ(
      run("diagnose " + path("slow.csv") + " --robot " + path("robot.yaml") + " --only slack --no-filter")
          .exit,
      0)
      << "the extended robot is a robot file";
}

TEST_F(CliDiagnose, SaysWhatIsWrongWithItsArguments) {
  const auto fails = [&](const std::string& arguments, const std::string& words) {
    const Ran ran = run("diagnose " + arguments);
    EXPECT_EQ(ran.exit, 2) << arguments;
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
    EXPECT_TRUE(ran.out.empty()) << ran.out;
  };
  const std::string slow = path("slow.csv");
  fails("", "REC is required");
  fails(path("none.csv"), "does not exist");
  fails(slow + " " + slow, "is the same recording as");
  fails(slow + " --only gremlins", "is no effect");
  fails(slow + " --threads 0", "--threads");
  fails(slow + " --zeros free", "--zeros");
  fails(slow + " --skip-start soon", "--skip-start");
  fails(slow + " --material 0mm", "--material");
  fails(slow + " --robot " + slow, "slow.csv");
  fails(slow + " --out " + slow, "is the same file as the input");
  fails(slow + " --skip-start 100", "slow.csv");
}

TEST_F(CliDiagnose, RefusesRecordingsOfDifferentRobots) {
  std::string robot = base::readTextFile(base::resource("robots/raven2_left.yaml"));
  robot.replace(robot.find("name: RAVEN-II left"), 19, "name: RAVEN-II two ");
  write("other.yaml", robot);
  const std::string quick = "--no-images --duration 4 --trajectory sinusoid";
  const std::string one = simulate("one.capstan", quick),
                    two = simulate("two.capstan", quick + " --robot " + path("other.yaml"));
  const Ran ran = run("diagnose " + one + " " + two);
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("brings another robot than"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace capstan::testing
