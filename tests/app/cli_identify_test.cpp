/// What capstan-cli identify says and writes, and what it does not write where nothing came of it.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "tests/app/cli_fixture.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Cli;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Ran;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

TEST_F(Cli, AnIdentifiedRobotNamesItsOriginAndTrackNamesTheRobot) {
  const std::string file = simulate("s.capstan", std::string(kMotion) + "--duration 25");
  const Ran ran = run("identify " + file + " --parameters r_l1 --json - --out " + path("found.yaml"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(json::parse(ran.out)["result"], "batch");
  const std::string text = textOf("found.yaml");
  EXPECT_THAT(text, HasSubstr("# Identified from s.capstan, 2"));
  EXPECT_THAT(text, HasSubstr(" s, by the batch method of capstan "));
  EXPECT_THAT(text, HasSubstr("#   r_l1 5"));
  EXPECT_THAT(text, HasSubstr(" ± "));
  const Ran tracked = run("track " + file + " --estimator-robot " + path("found.yaml"));
  ASSERT_EQ(tracked.exit, 0) << tracked.err;  // it reads back
  EXPECT_THAT(tracked.out, HasSubstr("(of " + path("found.yaml") + ")"));
  EXPECT_THAT(run("track " + file).out, HasSubstr("(of the session)"));
  EXPECT_EQ(
      json::parse(
          run("track --json - " + file + " --estimator-robot " + path("found.yaml")).out)["robot"]["file"],
      path("found.yaml"));
}

TEST_F(Cli, WhatCannotBeSeenLeavesNoRobot) {
  const std::string file = simulate("s.capstan", "--trajectory hold --no-images --duration 3");
  const Ran ran = run("identify " + file + " --parameters b_e1 --out " + path("none.yaml") +
                      " --tracking-out " + path("o.yaml"));
  EXPECT_EQ(ran.exit, 1);
  EXPECT_THAT(ran.err,
              HasSubstr("no parameter is observable in this motion; not written: " + path("none.yaml")));
  EXPECT_FALSE(fs::exists(path("none.yaml")));
  EXPECT_FALSE(fs::exists(path("o.yaml")));
  // Both methods see nothing; it is said once, in lines that fit a terminal.
  const std::size_t batch = ran.out.find("batch: ");
  ASSERT_NE(batch, std::string::npos) << ran.out;
  EXPECT_THAT(ran.out.substr(0, batch), HasSubstr("  b_e1: joint 1's damping"));
  EXPECT_THAT(ran.out.substr(batch), HasSubstr("  b_e1: not observable, as above\n"));
  for (const std::string& line : split(ran.out, '\n'))
    if (line.rfind("  b_e1", 0) == 0 || line.rfind("      ", 0) == 0) {
      EXPECT_LE(line.size(), 100U) << line;
    }
}

TEST_F(Cli, ARecordingGivenTwiceIsRefused) {
  const std::string file = simulate("s.capstan", std::string(kMotion) + "--duration 3");
  fs::copy_file(file, path("copy.capstan"));
  for (const std::string& again : {file, path("copy.capstan"), path("./s.capstan")}) {
    const Ran ran = run("identify " + file + " " + again + " --out " + path("none.yaml"));
    EXPECT_EQ(ran.exit, 2) << again;
    EXPECT_THAT(ran.err, HasSubstr(again + ": is the same recording as " + file + ": it would count twice"));
    EXPECT_THAT(ran.err, HasSubstr("Give each recording once"));
  }
}

class CliTable : public Cli {
 protected:
  /// Lines of a simulated sinusoid as a measured table, the header first; a tracking system ten times as
  /// noisy as the cameras measured it.
  std::vector<std::string> tableOf(double seconds) const {
    std::string truth = base::readTextFile(base::resource("truth/default.yaml"));
    const std::string detector = "pixel_sigma: 0.025";
    truth.replace(truth.find(detector), detector.size(), "pixel_sigma: 0.3");
    write("noisy.yaml", truth);
    const std::string file = simulate(
        "s.capstan", kMotion + ("--truth " + path("noisy.yaml") + " --duration " + std::to_string(seconds)));
    EXPECT_EQ(run("convert " + file + " " + path("t.csv")).exit, 0);
    return split(textOf("t.csv"), '\n');
  }
};

/// A single motor sample: nothing that a method could follow.
TEST_F(CliTable, WhereTheMethodsFindNothingTheyAreNamedAndNoFileIsLeft) {
  const std::vector<std::string> lines = tableOf(2.0);
  const auto seen = std::find_if(lines.begin() + 1, lines.end(),
                                 [](const std::string& line) { return line.back() != ','; });
  ASSERT_NE(seen, lines.end());
  write("one.csv", lines.front() + "\n" + *seen + "\n");
  for (const char* method : {"both", "batch", "dual-ukf"}) {
    const Ran ran =
        run("identify " + path("one.csv") + " --method " + method + " --out " + path("none.yaml"));
    EXPECT_EQ(ran.exit, 1) << method;
    EXPECT_THAT(ran.err, HasSubstr("nothing was identified: the ")) << method;
    EXPECT_THAT(ran.err, HasSubstr("found nothing (no camera observations)")) << method;
    EXPECT_THAT(ran.err, HasSubstr("not written: " + path("none.yaml"))) << method;
    EXPECT_FALSE(fs::exists(path("none.yaml"))) << method;
    EXPECT_THAT(ran.out, Not(HasSubstr("not observable"))) << method;
  }
}

/// A motor count beyond all bounds: the cable's force is not finite, and least squares fails; the filter,
/// robust as it is, goes on.
TEST_F(CliTable, TheDualUkfStandsInForABatchThatFailed) {
  std::vector<std::string> lines = tableOf(25.0);
  for (std::size_t i = lines.size() - 400; i < lines.size() - 395; ++i) {
    const std::size_t begin = lines[i].find(',') + 1;
    lines[i].replace(begin, lines[i].find(',', begin) - begin, "1e6");
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  write("spike.csv", text);
  const std::string command = "identify " + path("spike.csv") + " --parameters r_l1 --out " + path("r.yaml");
  const Ran ran = run(command + " --json -");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.err,
              HasSubstr("the batch method found nothing (failed): the result is that of the dual UKF"));
  const json document = json::parse(ran.out);
  EXPECT_EQ(document["result"], "dual-ukf");
  EXPECT_EQ(document["batch"]["end"], "failed");
  EXPECT_TRUE(document["batch"]["parameters"].empty());
  EXPECT_THAT(textOf("r.yaml"), HasSubstr("by the dual-ukf method"));
  const double radius = document["dual_ukf"]["parameters"][0]["value"];
  EXPECT_NEAR(radius, 0.059, 0.0005);  // the truth file's
  EXPECT_THAT(textOf("r.yaml"), HasSubstr("link_radius: " + std::to_string(radius).substr(0, 6)));

  write("find.yaml",
        "name: find\nwork: identify\nidentification: {parameters: r_l1, robot: batch}\n"
        "trials:\n  - {name: spike, recording: spike.csv}\n");
  const std::string experiment = "experiment " + path("find.yaml") + " --out " + path("out");
  for (const char* words :
       {"find: the batch method found nothing (failed): the result is that of the dual UKF",
        "find: an earlier run found nothing by the requested method"}) {
    const Ran made = run(experiment);
    ASSERT_EQ(made.exit, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr(words));
    EXPECT_THAT(made.out, HasSubstr("Batch: failed."));
  }
  EXPECT_THAT(textOf("out/find/robot.yaml"), HasSubstr("by the dual-ukf method"));

  fs::remove(path("r.yaml"));
  EXPECT_EQ(run(command + " --method batch").exit, 1);
  EXPECT_FALSE(fs::exists(path("r.yaml")));
  const Ran words = run(command + " --method dual-ukf");
  EXPECT_THAT(words.out, HasSubstr("s more of this motion are needed (σ is "));
  EXPECT_THAT(words.out, HasSubstr("%, its goal 0.2 %)"));
}

TEST_F(CliTable, AnExperimentThatFindsNothingSaysSo) {
  const std::vector<std::string> lines = tableOf(2.0);
  const auto seen = std::find_if(lines.begin() + 1, lines.end(),
                                 [](const std::string& line) { return line.back() != ','; });
  write("one.csv", lines.front() + "\n" + *seen + "\n");
  write("find.yaml",
        "name: find\nwork: identify\nidentification: {parameters: r_l1, robot: batch}\n"
        "trials:\n  - {name: one, recording: one.csv}\n");
  const Ran ran = run("experiment " + path("find.yaml") + " --out " + path("out"));
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err,
              HasSubstr("find.yaml:5: trials: the batch method found nothing (no camera observations), nor"));
  EXPECT_FALSE(fs::exists(path("out/find/robot.yaml")));
}

TEST_F(Cli, AFolderThatCannotBeMadeIsNamedAsItWasGiven) {
  write("small.yaml", "name: small\nwork: track\nimages: false\ntrials:\n  - {name: a, duration: 1}\n");
  for (const char* place : {"/proc/x", "/proc/version/x"}) {
    const Ran ran = run("experiment " + path("small.yaml") + " --out " + place);
    EXPECT_EQ(ran.exit, 2);
    EXPECT_THAT(ran.err, HasSubstr(std::string("--out = ") + place + ": cannot be"));
    EXPECT_THAT(ran.err, HasSubstr("Give a folder that"));
  }
}

}  // namespace
}  // namespace capstan
