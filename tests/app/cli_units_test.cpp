#include <algorithm>
#include <cmath>

#include "core/recording/measured_table.h"
#include "tests/app/cli_fixture.h"

namespace capstan {
namespace {

using testing::Cli;
using testing::json;
using testing::Ran;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

void scale(recording::TableColumns& columns, double factor) {
  for (auto& column : columns)
    for (double& value : column) value *= factor;
}

/// A measured table of a simulated session, and the same in other units.
class CliUnits : public Cli {
 protected:
  CliUnits() {
    const std::string file = simulate("s.capstan", "--trajectory sinusoid --no-images --duration 12");
    EXPECT_EQ(run("convert " + file + " " + path("si.csv")).exit, 0);
    si_ = recording::readMeasuredTable(path("si.csv"));
  }

  /// Writes what `change` makes of the table in SI; its path.
  template <class Change>
  std::string written(const std::string& name, const Change& change) const {
    recording::MeasuredTable table = si_;
    change(table);
    write(name, recording::formatMeasuredTable(table));
    return path(name);
  }

  json tracked(const std::string& arguments) const {
    const Ran ran = run("track " + arguments + " --json -");
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.exit == 0 ? json::parse(ran.out) : json();
  }

  recording::MeasuredTable si_;
};

void expectSameRms(const json& si, const json& other) {
  for (const char* estimator : {"kin", "cam", "ukf"})
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const double expected = si["rms"][estimator][joint], got = other["rms"][estimator][joint];
      EXPECT_NEAR(got, expected, 1e-6 * std::max(std::abs(expected), 1e-3)) << estimator << joint + 1;
    }
  EXPECT_NEAR(si["nis"].get<double>(), other["nis"].get<double>(), 1e-6);
}

TEST_F(CliUnits, MotorsInDegreesAreRefusedAndReadAsDegrees) {
  const std::string file = written("deg.csv", [](auto& table) { scale(table.q_m, kDegrees); });
  const Ran refused = run("track " + file);
  EXPECT_EQ(refused.exit, 2) << refused.out;
  for (const char* words : {"q_m1", "q_m2", "q_m3", "degrees", "--read-as q_m=deg", "q_m=keep"})
    EXPECT_NE(refused.err.find(words), std::string::npos) << words << " in\n" << refused.err;
  expectSameRms(tracked(path("si.csv")), tracked(file + " --read-as q_m=deg"));
  EXPECT_EQ(run("track " + file + " --read-as q_m=keep").exit, 0) << "taken as it stands where asked";
}

TEST_F(CliUnits, EveryQuantityInOtherUnitsIsTheSameTable) {
  const std::string file = written("all.csv", [](auto& table) {
    scale(table.q_m, kDegrees);
    scale(table.dq_m, kDegrees);
    scale(table.p_c, 1e3);
    for (std::size_t joint : {0, 1})
      for (double& value : table.q[joint]) value *= kDegrees;
    for (double& value : table.q[2]) value *= 1e3;
    for (double& value : table.t) value *= 1e3;
  });
  const Ran refused = run("track " + file);
  EXPECT_EQ(refused.exit, 2);
  const std::string option = "--read-as q_m=deg,dq_m=deg,q1=deg,q2=deg,q3=mm,p_c=mm,t=ms";
  for (const char* words : {"q_m=deg", "dq_m=deg", "q1=deg", "q2=deg", "q3=mm", "p_c=mm", "t=ms"})
    EXPECT_NE(refused.err.find(words), std::string::npos) << words << " in\n" << refused.err;
  expectSameRms(tracked(path("si.csv")), tracked(file + " " + option));
  const Ran part = run("track " + file + " --read-as q_m=deg");
  EXPECT_EQ(part.exit, 2) << "p_c is still requested";
  EXPECT_NE(part.err.find("p_c=mm"), std::string::npos) << part.err;
}

// The RAVEN-II's software publishes the insertion axis as metres times 180/π too.
TEST_F(CliUnits, InsertionAsTheRavensSoftwarePublishesIt) {
  const std::string file = written("raven.csv", [](auto& table) { scale(table.q, kDegrees); });
  const Ran refused = run("track " + file);
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.err.find("--read-as q=deg"), std::string::npos) << refused.err;
  expectSameRms(tracked(path("si.csv")), tracked(file + " --read-as q=deg"));
}

TEST_F(CliUnits, EveryCommandThatReadsTablesRefuses) {
  const std::string file = written("deg.csv", [](auto& table) {
    scale(table.q_m, kDegrees);
    scale(table.p_c, 1e3);
  });
  const std::string option = " --read-as q_m=deg,p_c=mm";
  for (const std::string& command :
       {"info " + file, "identify " + file + " --parameters r_l1 --method dual-ukf",
        "diagnose " + file + " --no-filter --only backlash", "convert " + file + " " + path("out.capstan"),
        "convert " + file + " " + path("out.csv"), "report " + file + " --out " + path("report")}) {
    const Ran refused = run(command);
    EXPECT_EQ(refused.exit, 2) << command << "\n" << refused.out;
    EXPECT_NE(refused.err.find("--read-as q_m=deg,p_c=mm"), std::string::npos) << command << refused.err;
  }
  EXPECT_FALSE(std::filesystem::exists(path("out.csv"))) << "nothing is written of a table that is refused";
  EXPECT_EQ(run("info " + file + option).exit, 0);
  ASSERT_EQ(run("convert " + file + " " + path("back.csv") + option).exit, 0);
  const auto back = recording::readMeasuredTable(path("back.csv"));
  for (std::size_t joint = 0; joint < 3; ++joint)
    for (std::size_t row = 0; row < back.rows(); ++row)
      ASSERT_NEAR(back.q_m[joint][row], si_.q_m[joint][row], 1e-9);
  const Ran identified = run("identify " + file + " --parameters r_l1 --method dual-ukf --json -" + option);
  ASSERT_EQ(identified.exit, 0) << identified.err;
  const Ran expected = run("identify " + path("si.csv") + " --parameters r_l1 --method dual-ukf --json -");
  const double r_l1 = json::parse(identified.out)["dual_ukf"]["parameters"][0]["value"];
  EXPECT_NEAR(r_l1, json::parse(expected.out)["dual_ukf"]["parameters"][0]["value"].get<double>(), 1e-8);
}

TEST_F(CliUnits, OptionsThatMeanNothingAreRefused) {
  for (const char* option : {"q_m=furlongs", "q_x=deg", "q_m", "t=deg", "q_m=mm", "tau_ext=keep"}) {
    const Ran refused = run("track " + path("si.csv") + " --read-as " + std::string(option));
    EXPECT_EQ(refused.exit, 2) << option;
    EXPECT_NE(refused.err.find("read-as"), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace capstan
