/// Motor encoders that fail, and cameras whose clock is late: options of track and identify.
#include "core/base/yaml.h"
#include "core/tracking/options.h"
#include "tests/app/cli_fixture.h"

namespace capstan {
namespace {

using nlohmann::json;
using testing::Cli;
using testing::Ran;

TEST_F(Cli, AMotorsEncoderIsMadeToFail) {
  const std::string file = simulate("s.capstan", std::string(kMotion) + "--duration 6");
  const json lost = json::parse(run("track --json - --fail-motor 2@2:lost " + file).out);
  ASSERT_EQ(lost["motor_failed"].size(), 1U);
  EXPECT_EQ(lost["motor_failed"][0]["motor"], 2);
  EXPECT_EQ(lost["motor_failed"][0]["fault"], "lost");
  EXPECT_NEAR(lost["motor_failed"][0]["since"].get<double>(), 2.1, 3e-3);

  const Ran frozen = run("track --fail-motor 1@2 " + file);
  EXPECT_EQ(frozen.exit, 0) << frozen.err;
  EXPECT_NE(frozen.out.find("encoder frozen since"), std::string::npos) << frozen.out;
  EXPECT_NE(frozen.out.find("joint 1 from the camera alone"), std::string::npos) << frozen.out;

  const std::string two = "track --json - --fail-motor 1@2:lost --fail-motor 3@3:lost ";
  EXPECT_EQ(json::parse(run(two + file).out)["motor_failed"].size(), 2U);
  EXPECT_EQ(json::parse(run("track --json - --fail-motor all@2:lost " + file).out)["motor_failed"].size(),
            3U);
  EXPECT_TRUE(json::parse(run("track --json - " + file).out)["motor_failed"].empty());
}

TEST_F(Cli, AMotorsEncoderIsDeclaredFailed) {
  const std::string file = simulate("s.capstan", std::string(kMotion) + "--truth matched --duration 4");
  const json healthy = json::parse(run("track --json - " + file).out);
  const json failed = json::parse(run("track --json - --failed-motor 3 " + file).out);
  ASSERT_EQ(failed["motor_failed"].size(), 1U);
  EXPECT_EQ(failed["motor_failed"][0]["motor"], 3);
  EXPECT_EQ(failed["motor_failed"][0]["fault"], "declared");
  EXPECT_GT(failed["rms"]["ukf"][2].get<double>(), 2.0 * healthy["rms"]["ukf"][2].get<double>())
      << "the camera alone";
  EXPECT_EQ(failed["rms"]["cam"][0], healthy["rms"]["cam"][0]);
}

TEST_F(Cli, WrongMotorsAreRefused) {
  for (const char* wrong : {"5@2", "2", "2@x", "2@1:broken"}) {
    const Ran ran = run("track --simulate --no-images --duration 1 --fail-motor " + std::string(wrong));
    EXPECT_EQ(ran.exit, 2) << wrong;
    EXPECT_NE(ran.err.find(std::string("--fail-motor = ") + wrong), std::string::npos) << ran.err;
  }
  const Ran ran = run("track --simulate --no-images --duration 1 --failed-motor 4");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("--failed-motor"), std::string::npos) << ran.err;
}

TEST_F(Cli, IdentifyRefusesARecordingThatNeverHadAMotor) {
  std::string table = "t,q_m1,q_m2,q_m3,q1,q2,q3\n";
  for (int row = 0; row < 3000; ++row) table += std::to_string(1e-3 * row) + ",60,,-480,0.6,1.6,0.34\n";
  write("t.csv", table);
  const Ran ran = run("identify " + path("t.csv"));
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("a motor encoder that failed from the beginning"), std::string::npos) << ran.err;
}

/// The delay that identify finds is the simulation's; track takes it from the file and sees what is there.
TEST_F(Cli, TheCamerasDelayGoesFromIdentifyToTrack) {
  write("late.yaml", "cameras:\n  stamp_delay: 0.03\n");
  const std::string file =
      simulate("s.capstan", std::string(kMotion) + "--duration 30 --truth " + path("late.yaml"));
  const std::string method = " --parameters r_l1 --method dual-ukf ";
  const Ran ran = run("identify " + file + method + "--json - --tracking-out " + path("o.yaml"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const double delay = json::parse(ran.out)["dual_ukf"]["camera"]["delay"].get<double>();
  EXPECT_NEAR(delay, 0.03, 0.003);
  const auto options = base::readYamlFile<tracking::TrackingOptions>(path("o.yaml"));
  EXPECT_NEAR(options.camera_delay, delay, 1e-9);

  const auto rms = [&](const std::string& more) {
    return json::parse(run("track --json - " + file + more).out)["rms"]["cam"];
  };
  // The augmented filter finds the delay itself; the six-state one has what the file says.
  write("six.yaml", "filter: six_state\n");
  write("six-late.yaml", base::writeYaml(tracking::sixState(options)));
  const json stamped = rms(" --options " + path("six.yaml"));
  const json corrected = rms(" --options " + path("six-late.yaml"));
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(corrected[joint].get<double>(), 0.5 * stamped[joint].get<double>()) << joint;

  const Ran exact = run("identify " + file + method + "--exact-camera --tracking-out " + path("p.yaml"));
  EXPECT_EQ(exact.exit, 2);
  EXPECT_NE(exact.err.find("--tracking-out"), std::string::npos) << exact.err;
}

}  // namespace
}  // namespace capstan
