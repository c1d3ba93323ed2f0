// Arguments that make no sense are refused, and named.
#include <gmock/gmock.h>

#include "tests/app/cli_fixture.h"

namespace capstan::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

TEST_F(Cli, NumbersThatAreNoneAreRefused) {
  const std::string simulated = "track --simulate --no-images --duration 1 ";
  for (const std::string wrong :
       {"--seed -1", "--seed 99999999999999999999", "--duration nan", "--duration inf"}) {
    const Ran ran = run(simulated + wrong);
    EXPECT_EQ(ran.exit, 2) << wrong;
    EXPECT_THAT(ran.err, HasSubstr(wrong.substr(0, wrong.find(' '))));
  }
  EXPECT_EQ(run(simulated + "--seed 7").exit, 0);
}

TEST_F(Cli, AFileOfAnotherKindIsRefusedWithTheOptionThatTakesIt) {
  write("truth.yaml", "name: truth\n");
  const Ran as_recording = run("track " + path("truth.yaml"));
  EXPECT_EQ(as_recording.exit, 2);
  EXPECT_THAT(as_recording.err, HasSubstr("--robot"));
  const Ran no_truth = run("simulate --duration 1 --truth nominal --out " + path("s.capstan"));
  EXPECT_EQ(no_truth.exit, 2);
  EXPECT_THAT(no_truth.err, HasSubstr("truth = nominal"));
  EXPECT_FALSE(fs::exists(path("s.capstan")));
}

TEST_F(Cli, RegistrationAtTheHardStopNeedsImages) {
  write("t.csv", "t,q_m1,q_m2,q_m3\n0,80,-80,-480\n0.001,80,-80,-480\n0.002,80,-80,-480\n");
  const Ran ran = run("track " + path("t.csv") + " --register hard-stop");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("no images"));
}

TEST_F(Cli, AMotorThatFailsAfterTheEndIsSaid) {
  const Ran ran = run("track --simulate --no-images --duration 1 --fail-motor 2@60");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("--fail-motor: the recording ends at"));
}

TEST_F(Cli, VersionIsThatOfTheFilesItWrites) {
  std::istringstream words(run("--version").out);
  std::string program, version;
  words >> program >> version;
  EXPECT_EQ(program, "capstan-cli");
  const std::string file = simulate("s.capstan", "--no-images --duration 1");
  EXPECT_THAT(run("info " + file).out, HasSubstr("capstan " + version));
}

TEST_F(Cli, VersionNamesTheLibraries) {
  const std::string text = run("--version").out;
  for (const char* library : {"OpenCV", "Eigen", "Ceres", "SQLite", "Qt"})
    EXPECT_THAT(text, ContainsRegex(std::string("\n") + library + " +[0-9]+\\.[0-9]+"));
}

}  // namespace
}  // namespace capstan::testing
