// The manual's worked examples do what the manual says of them.
#include <gmock/gmock.h>

#include <regex>

#include "tests/app/cli_fixture.h"
#include "tests/support/folders.h"

namespace capstan::testing {
namespace {

using ::testing::HasSubstr;

const fs::path kManual = test::resourceFile("manual/examples");
const std::string kRobot = test::resourceFile("robots/raven2_left.yaml");

std::string textOfFile(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class ExamplesTest : public Cli {
 protected:
  /// A measured table of some seconds, and what `track` makes of it.
  void SetUp() override {
    ASSERT_EQ(run("simulate --no-images --duration 4 --trajectory sinusoid --truth matched --out " +
                  path("s.capstan"))
                  .exit,
              0);
    ASSERT_EQ(run("convert " + path("s.capstan") + " " + table_).exit, 0);
    const Ran tracked =
        run("track " + table_ + " --robot " + kRobot + " --out " + path("cli.csv") + " --json -");
    ASSERT_EQ(tracked.exit, 0) << tracked.err;
    report_ = json::parse(tracked.out);
  }
  /// A shell command in the test's folder, with the programs that the manual expects.
  Ran shell(const std::string& command) const {
    return runShell("set -e; cd " + path("") + "; export CAPSTAN_CLI='" + test::commandLineProgram() +
                    "' CAPSTAN_RESOURCES='" + test::sourceFile("resources").string() +
                    "'; PATH=\"$(dirname " + test::commandLineProgram() + "):$PATH\"; " + command);
  }
  static std::string example(const std::string& name) { return std::string(CAPSTAN_EXAMPLES) + "/" + name; }

  const std::string table_ = path("t.csv");
  json report_;
};

/// Time [s] and UKF estimate of joint 1 [rad] in a table of estimates with a header.
std::vector<std::pair<double, double>> jointOne(const std::string& csv, std::size_t column, bool motor_rows) {
  std::vector<std::pair<double, double>> all;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (motor_rows && cells.at(1) == "1") continue;
    all.emplace_back(std::stod(cells.at(0)), std::stod(cells.at(column)));
  }
  return all;
}

TEST_F(ExamplesTest, ALibraryTracksAsTheCommandLineDoes) {
  const Ran ran = shell(example("track_table") + " " + kRobot + " t.csv out.csv");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto ours = jointOne(textOf("out.csv"), 1, false), theirs = jointOne(textOf("cli.csv"), 9, true);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) ASSERT_NEAR(ours[i].second, theirs[i].second, 1e-8) << i;
  EXPECT_EQ(shell(example("track_table") + " " + kRobot + " none.csv out.csv").exit, 2);
}

TEST_F(ExamplesTest, ASourceReadsAPipe) {
  const std::string lines =
      R"(awk -F, 'NR > 1 { print "m", $1, $2, $3, $4; if ($14 != "") print "c", $1, $14, $15, $16 }' t.csv)";
  const Ran ran = shell(lines + " | " + example("own_source") + " " + kRobot);
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr(std::to_string(report_["samples"].get<int>()) + " motor samples, " +
                                 std::to_string(report_["camera_samples"].get<int>()) + " tips"));
  const Ran wrong = shell("printf 'm 0 1 2 3\\nx 1\\n' | " + example("own_source") + " " + kRobot);
  EXPECT_EQ(wrong.exit, 2);
  EXPECT_THAT(wrong.err, HasSubstr("standard input:2: line = x 1: is no sample"));
}

TEST_F(ExamplesTest, AFigureIsExported) {
  const Ran ran = shell(example("own_figure") + " " + kRobot + " t.csv nis");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(textOf("nis.pdf").rfind("%PDF", 0), 0U);
  EXPECT_THAT(textOf("nis.svg"), HasSubstr("<svg"));
  EXPECT_EQ(textOf("nis.png").substr(1, 3), "PNG");
  EXPECT_EQ(std::ranges::count(textOf("nis.csv"), '\n'), report_["gates"]["camera"].get<long>() + 1);
}

TEST_F(ExamplesTest, PythonReadsEstimatesIntoPandas) {
  if (runShell("/usr/bin/python3 -c 'import pandas'").exit != 0) GTEST_SKIP() << "needs python3-pandas";
  const Ran ran = shell("/usr/bin/python3 " + (kManual / "track.py").string() + " " + kRobot + " t.csv");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("table,joint,kinematics,camera,UKF\nt.csv,1,"));
  EXPECT_EQ(std::ranges::count(ran.out, '\n'), 4);
  const Ran wrong = shell("/usr/bin/python3 " + (kManual / "track.py").string() + " " + kRobot + " none.csv");
  EXPECT_EQ(wrong.exit, 1);
  EXPECT_THAT(wrong.err, HasSubstr("none.csv"));
}

TEST_F(ExamplesTest, OctaveReadsEstimates) {
  if (runShell("octave --version").exit != 0) GTEST_SKIP() << "needs octave";
  const Ran ran = shell("octave --no-gui -q " + (kManual / "track.m").string() + " " + kRobot + " t.csv");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("RMS kinematics"));
  const auto rows = jointOne(textOf("cli.csv"), 9, false).size();
  EXPECT_THAT(ran.out, HasSubstr(std::to_string(rows) + " rows, joint 1"));
}

/// Blocks of `language` in a Markdown text, each with the last `file` named before it.
std::vector<std::pair<std::string, std::string>> blocksOf(const std::string& text,
                                                          const std::string& language) {
  std::vector<std::pair<std::string, std::string>> all;
  const std::regex pattern("`((?:core|app|widgets)/[a-z_/]+\\.(?:h|cpp))`|\n```" + language + "\n([^`]*)```");
  std::string file;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    if ((*match)[1].matched)
      file = (*match)[1];
    else
      all.emplace_back(file, (*match)[2]);
  return all;
}

TEST_F(ExamplesTest, TheHypothesisIsInItsFilesAsQuotedAndIsFound) {
  const std::string page = textOfFile(kManual / "hypothesis.md");
  const auto quoted = blocksOf(page, "cpp");
  ASSERT_EQ(quoted.size(), 8U);
  for (const auto& [file, block] : quoted)
    EXPECT_THAT(textOfFile(test::sourceFile(file)), HasSubstr(block)) << file;
  const auto commands = blocksOf(page, "sh");
  ASSERT_EQ(commands.size(), 1U);
  const Ran ran = shell(commands[0].second);
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const json found = json::parse(textOf("diagnosis.json"));
  EXPECT_EQ(found["verdict"], "found");
  EXPECT_EQ(found["causes"][0]["effect"], "zero_drift");
  EXPECT_EQ(found["causes"][0]["joint"], 2);
}

}  // namespace
}  // namespace capstan::testing
