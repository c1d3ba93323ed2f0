/// What capstan-cli says of a recording: exclusions about units, what the reference is, the NIS verdict.
#include "tests/app/cli_fixture.h"
#include "tests/support/folders.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Cli;
using testing::Ran;

TEST_F(Cli, UnitsThatCannotBeAreRefusedOnStandardError) {
  std::string table = "t,q_m1,q_m2,q_m3,q1,q2,q3\n";
  for (int row = 0; row < 200; ++row) table += std::to_string(row) + ",80,-80,-480,0.6,1.6,340\n";
  write("mm.csv", table);
  for (const char* command : {"track ", "info ", "identify "}) {
    const Ran result = run(command + path("mm.csv"));
    EXPECT_EQ(result.exit, 2) << command;
    EXPECT_NE(result.err.find("q3 is 340: as m it would leave the range of joint 3, 0.23 … 0.56 m"),
              std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("--read-as t=ms,q3=mm"), std::string::npos) << result.err;
  }
  const Ran info = run("info --json - " + path("mm.csv"));
  EXPECT_EQ(json::parse(info.out)["implausible_units"].size(), 2U) << "told all the same";
}

TEST_F(Cli, AMotorLogIsComparedWithItsOwnKinematicsByName) {
  std::string log =
      "t_s,mpos1_deg,mpos2_deg,mpos3_deg,mvel1_degps,mvel2_degps,mvel3_degps,jpos1_deg,jpos2_deg,"
      "jpos3_m_times_57.2958,tau1,tau2,tau3\n";
  for (int row = 0; row < 300; ++row)
    log += std::to_string(1e-3 * row) + ",4086,10937,49430,0,0,0,30,90,22.9,0,0,0\n";
  write("log.csv", log);
  const Ran text = run("track " + path("log.csv"));
  ASSERT_EQ(text.exit, 0) << text.err;
  EXPECT_EQ(text.out.rfind("reference: the robot's own kinematics, no truth", 0), 0U) << text.out;
  EXPECT_EQ(json::parse(run("track --json - " + path("log.csv")).out)["reference"], "own kinematics");
  ASSERT_EQ(run("convert " + path("log.csv") + " " + path("log.capstan")).exit, 0);
  EXPECT_EQ(json::parse(run("track --json - " + path("log.capstan")).out)["reference"], "own kinematics");
  for (const char* from : {"log.csv", "log.capstan"})
    EXPECT_NE(run("convert --force " + path(from) + " " + path("t.csv")).err.find("own kinematics"),
              std::string::npos)
        << from;
  EXPECT_NE(run("info " + path("log.capstan")).out.find("own kinematics"), std::string::npos);
  ASSERT_EQ(run("report " + path("log.capstan") + " --out " + path("r")).exit, 0);
  EXPECT_NE(textOf("r/index.html").find("Differences from the robot's own kinematics"), std::string::npos);

  const std::string file = simulate("s.capstan", "--trajectory sinusoid --no-images --duration 2");
  EXPECT_EQ(json::parse(run("track --json - " + file).out)["reference"], "joint encoders");
  EXPECT_EQ(run("track " + file).out.find("own kinematics"), std::string::npos);
}

TEST_F(Cli, TheNisVerdictHasItsBandAndSaysWhatFailureMeans) {
  const std::string file = simulate("s.capstan", "--trajectory sinusoid --no-images --duration 6");
  write("six.yaml", "filter: six_state\n");  // the augmented filter carries what is wrong, and passes
  const std::string six = " --options " + path("six.yaml");
  const std::string command = "track " + file + six;
  const json report = json::parse(run(command + " --json -").out);
  ASSERT_GT(report["nis"].get<double>(), report["nis_band"][1].get<double>()) << "a wrong radius";
  EXPECT_LT(report["nis_band"][0].get<double>(), 1.0);
  EXPECT_GT(report["nis_band"][1].get<double>(), 1.0);
  EXPECT_FALSE(report["nis_consistent"].get<bool>());
  const std::string text = run(command).out;
  EXPECT_NE(text.find("95 % band"), std::string::npos) << text;
  EXPECT_NE(text.find("FAIL"), std::string::npos) << text;
  EXPECT_NE(text.find("as with a wrong parameter of the robot file or cameras that were moved: see identify"),
            std::string::npos)
      << text;

  const std::string matched = "track --simulate --truth matched --no-images --duration 20" + six;
  const json calm = json::parse(run(matched + " --json -").out);
  ASSERT_LT(calm["nis"].get<double>(), calm["nis_band"][0].get<double>());
  EXPECT_EQ(calm["nis_verdict"], "cautious");
  const std::string cautious = run(matched).out;
  EXPECT_NE(cautious.find(": cautious"), std::string::npos) << cautious;
  EXPECT_EQ(cautious.find("FAIL"), std::string::npos) << cautious;
  EXPECT_EQ(report["nis_verdict"], "FAIL, too high");

  const json none = json::parse(run("track --simulate --no-cameras --duration 1 --json -").out);
  EXPECT_TRUE(none["nis_band"].is_null());
  EXPECT_TRUE(none["nis_consistent"].is_null());
  const std::string page = path("r");
  ASSERT_EQ(run("report " + file + six + " --out " + page).exit, 0);
  EXPECT_NE(textOf("r/index.html").find("FAIL"), std::string::npos);
  EXPECT_NE(textOf("r/index.html").find("see identify"), std::string::npos);
}

TEST_F(Cli, OptionsThatWouldBeIgnoredAreRefused) {
  const std::string out = " --out " + path("r");
  for (const auto& [arguments, named] :
       {std::pair{std::string("track --simulate --no-images --duration 1 --mounting m.yaml"), "--mounting"},
        std::pair{std::string("track --simulate --no-images --duration 1 --format table"), "--format"},
        std::pair{"track --simulate --no-cameras --duration 1 --save-registration " + path("s.yaml"),
                  "--save-registration"},
        std::pair{"report --duration 1 --format raven" + out, "--format"},
        std::pair{std::string("track --unregistered"), "--unregistered"}}) {
    const Ran result = run(arguments);
    EXPECT_EQ(result.exit, 2) << arguments;
    EXPECT_NE(result.err.find(named), std::string::npos) << arguments << ": " << result.err;
  }
}

TEST_F(Cli, ReportTakesTheWindowsNames) {
  const std::string file = simulate("s.capstan", "--trajectory sinusoid --no-images --duration 2");
  const auto rmsOf = [&](const std::string& arguments) {
    const Ran made = run("report --json - --out " + path("r") + " " + arguments);
    EXPECT_EQ(made.exit, 0) << arguments << made.err;
    return json::parse(made.out)["rms"];
  };
  const json rms = rmsOf(file);
  EXPECT_EQ(rmsOf("--session " + file), rms);
  ASSERT_EQ(run("convert " + file + " " + path("t.csv")).exit, 0);
  EXPECT_EQ(rmsOf("--table " + path("t.csv") + " --robot " +
                  test::resourceFile("robots/raven2_left.yaml").string()),
            rmsOf(path("t.csv")));
  const Ran made =
      run("report --simulate --distractors --uneven-light --unregistered --seed 4 --truth matched "
          "--trajectory hold --no-images --duration 1 --theme light --out " +
          path("r"));
  EXPECT_EQ(made.exit, 0) << made.err;
  EXPECT_NE(made.err.find("--theme"), std::string::npos);
  for (const std::string& wrong : {"--simulate " + file, "--simulate --session " + file,
                                   "--table " + path("t.csv") + " --session " + file,
                                   file + " --session " + file, file + " --unregistered"})
    EXPECT_EQ(run("report --out " + path("r") + " " + wrong).exit, 2) << wrong;
}

TEST_F(Cli, ReportSaysWhatItsNumbersCount) {
  const std::string file = simulate("s.capstan", "--trajectory sinusoid --no-images --duration 2");
  ASSERT_EQ(run("report " + file + " --out " + path("r")).exit, 0);
  EXPECT_NE(textOf("r/index.html").find("at most 200 points per second"), std::string::npos);
  EXPECT_NE(textOf("r/joints.svg").find("points drawn"), std::string::npos);
}

}  // namespace
}  // namespace capstan
