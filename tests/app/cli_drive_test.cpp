/// capstan-cli identify for a robot of one joint: fit, judgement on held-out recordings, robot file,
/// refusals.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/cli_fixture.h"
#include "tests/support/folders.h"

namespace capstan {
namespace {

using nlohmann::json;
using testing::Cli;
using testing::Ran;

const std::string kJaw = test::sourceFile("tests/core/identification/data/davinci_jaw.yaml");

class CliDrive : public Cli {
 protected:
  /// A linear spring of 2 N·m/rad at the spindle, 0.03 N·m of friction at the joint, 0.02 N·m at the motor
  /// and a gear of 0.9, in closed form.
  std::string record(const std::string& name, double load, double frequency) {
    constexpr double kGear = 0.9, kStiffness = 2.0, kFriction = 0.03, kMotor = 0.02;
    std::string table = "t,q_m1,tau_m1,q1,tau_ext1\n";
    double q = 0.0;
    for (int k = 0; k < 1000; ++k) {
      const double t = 0.01 * k, w = 6.283185307179586 * frequency;
      const double q_m = 0.5 - 0.5 * std::cos(w * t);
      const auto edge = [&](double torque) { return kGear * (torque * kGear / kStiffness - q_m); };
      q = std::clamp(q, edge(-load - kFriction), edge(-load + kFriction));
      const double speed = 0.5 * w * std::sin(w * t);
      const double torque = kStiffness * (q_m + q / kGear) + kMotor * std::tanh(speed / 0.02);
      table += std::to_string(t) + "," + std::to_string(q_m) + "," + std::to_string(torque) + "," +
               std::to_string(1.2 + q) + "," + std::to_string(-load) + "\n";
    }
    write(name, table);
    return path(name);
  }
  /// The jaw with a linear cable and without what record() does not have: damping, viscous friction.
  std::string plainJaw() {
    std::stringstream text;
    text << std::ifstream(kJaw).rdbuf();
    std::string robot = text.str();
    for (const auto& [from, to] : {std::pair{"viscous: 1.0e-3", "viscous: 1.0e-9"},
                                   {"cable_damping: 200.0", "cable_damping: 1.0e-6"},
                                   {"cable_exponent: 200.0", "cable_exponent: 1.0"},
                                   {"cable_stiffness: 100.0", "cable_stiffness: 2.0e4"}})
      for (std::size_t at = robot.find(from); at != std::string::npos; at = robot.find(from))
        robot.replace(at, std::string(from).size(), to);
    write("plain.yaml", robot);
    return path("plain.yaml");
  }
  void expectRefused(const std::string& arguments, const std::vector<std::string>& words) {
    const Ran result = run("identify " + arguments);
    EXPECT_EQ(result.exit, 2) << arguments << "\n" << result.err;
    for (const std::string& word : words)
      EXPECT_NE(result.err.find(word), std::string::npos) << word << " in\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
};

TEST_F(CliDrive, FindsTheDriveAndJudgesItOnHeldOutRecordings) {
  const std::string training = record("a.csv", 0.0, 0.3) + " " + record("b.csv", 0.1, 0.6);
  const std::string held_out = record("c.csv", 0.05, 0.4);
  const std::string fixed = " --robot " + plainJaw() + " --offsets shared --parameters r_l,k_c,f_c,tau_c ";
  const Ran ran = run("identify " + training + " --held-out " + held_out + fixed + "--json - --out " +
                      path("found.yaml"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json drive = json::parse(ran.out)["drive"];
  double radius = 0.0, stiffness = 0.0, friction = 0.0, motor = 0.0;
  for (const json& parameter : drive["parameters"]) {
    const double value = parameter["value"];
    if (parameter["name"] == "r_l") radius = value;
    if (parameter["name"] == "k_c") stiffness = value;
    if (parameter["name"] == "f_c") friction = value;
    if (parameter["name"] == "tau_c") motor = value;
  }
  EXPECT_NEAR(0.005 / radius, 0.9, 1e-3);
  EXPECT_NEAR(stiffness * 0.005 * 0.005, 2.0, 0.02);
  EXPECT_NEAR(friction, 0.03, 2e-4);
  EXPECT_NEAR(motor, 0.02, 2e-4);
  const auto rms = [&](const char* model) { return drive["scores"][model]["held_out"]["rms"].get<double>(); };
  EXPECT_LT(rms("cable"), 1e-4);
  EXPECT_LT(10.0 * rms("cable"), rms("stretch"));
  EXPECT_LT(rms("stretch"), rms("gear"));
  EXPECT_EQ(drive["scores"]["cable"]["held_out"]["recordings"].size(), 1U);

  const Ran text = run("identify " + training + " --held-out " + held_out + " --robot " + path("found.yaml"));
  ASSERT_EQ(text.exit, 0) << text.err;
  for (const char* word : {"RMS of the joint [deg]", "held out", "k_c [N/m]", "encoder zero", "c.csv"})
    EXPECT_NE(text.out.find(word), std::string::npos) << word << " in\n" << text.out;
}

TEST_F(CliDrive, RefusesWithFileColumnAndRemedy) {
  const std::string good = record("a.csv", 0.0, 0.3), robot = " --robot " + kJaw;
  write("unloaded.csv", "t,q_m1,q1\n0,1,1\n1,1,1\n");
  write("three.csv", "t,q_m1,q_m2,q_m3,q1,q2,q3\n0,1,1,1,1,1,1\n1,1,1,1,1,1,1\n");
  write("short.csv", "t,q_m1,q1,tau_ext1\n0,1,1,0\n0.5,1,1,0\n");
  expectRefused(path("unloaded.csv") + robot, {"unloaded.csv", "tau_ext1", "Add the measured load"});
  expectRefused(path("three.csv") + robot, {"three.csv", "q_m1…3", "3 joints", "Leave only the columns"});
  expectRefused(path("short.csv") + robot, {"short.csv", "Give a longer recording"});
  expectRefused(good + robot + " --held-out " + path("unloaded.csv"), {"unloaded.csv", "tau_ext1"});
  expectRefused(good + robot + " --held-out " + good, {"--held-out", "also a recording"});
  std::filesystem::copy_file(good, path("copy.csv"));
  expectRefused(good + " " + path("copy.csv") + robot, {"copy.csv", "it would count twice", "once"});
  expectRefused(good + robot + " --held-out " + path("copy.csv"), {"--held-out", "copy.csv", "also"});
  expectRefused(good + robot + " --parameters stiffness", {"--parameters", "stiffness", "r_l,k_c"});
  expectRefused(good + robot + " --trace " + path("t.csv"), {"--trace", "da Vinci jaw"});
  expectRefused(good + robot + " --out " + good, {"--out", "a.csv"});
  expectRefused(path("three.csv") + " --held-out " + good, {"--held-out", "--robot"});
}

}  // namespace
}  // namespace capstan
