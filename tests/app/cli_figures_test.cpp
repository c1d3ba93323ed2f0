/// capstan-cli figures: what it leaves of a recording, and what it refuses.
#include "tests/app/cli_fixture.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Cli;
using testing::Ran;

TEST_F(Cli, FiguresOfARecordingAreLeftInAFolderThatIsWrittenOverAndNoOther) {
  const std::string file = simulate("s.capstan", "--trajectory sinusoid --no-images --duration 3");
  const std::string command = "figures " + file + " --size 88x80 --out " + path("out");
  const Ran made = run(command + " --json -");
  ASSERT_EQ(made.exit, 0) << made.err;
  const json report = json::parse(made.out);
  EXPECT_EQ(report["figures"], 3) << "trajectory, histogram, boxes: too short for a detail\n" << made.out;
  for (const auto& name : report["files"]) EXPECT_TRUE(fs::exists(name.get<std::string>())) << name;
  for (const char* name : {"s-trajectory-s-page-1.pdf", "s-trajectory-s-page-3.pdf",
                           "s-histogram-s-page-2.svg", "s-boxplot-page-3.png", "s-boxplot.csv"})
    EXPECT_TRUE(fs::exists(path("out/") + name)) << name;
  EXPECT_NE(textOf("out/index.html").find("s-boxplot-page-1.svg"), std::string::npos);
  EXPECT_EQ(run(command + " --only boxplots").exit, 0) << "its own folder";

  // The file's own <title> is the caption in any case.
  const auto titlesIn = [&](const std::string& option, const std::string& out) {
    EXPECT_EQ(run("figures " + file + " --only histograms --out " + path(out) + option).exit, 0);
    const std::string svg = textOf(out + "/s-histogram-s.svg"), title = "error of the joint positions";
    const std::size_t first = svg.find(title);
    return first != std::string::npos && svg.find(title, first + 1) != std::string::npos;
  };
  EXPECT_TRUE(titlesIn("", "titled"));
  EXPECT_FALSE(titlesIn(" --no-titles", "untitled"));

  write("mine.txt", "mine");
  const Ran refused = run("figures " + file + " --out " + folder_.string());
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.err.find("is not empty and holds no former figures"), std::string::npos) << refused.err;
  EXPECT_EQ(textOf("mine.txt"), "mine");
}

TEST_F(Cli, FiguresSayWhatIsWrongWithTheirArguments) {
  fs::create_directories(path("empty"));
  const std::pair<std::string, const char*> wrong[] = {
      {"figures " + path("none.capstan"), "none.capstan: does not exist"},
      {"figures " + path("empty"), "holds no results.json"},
      {"figures " + path("empty") + " --size 88", "--size = 88: is no size"},
      {"figures " + path("empty") + " --size 10x60", "10 mm is not within 40 to 1000 mm"},
      {"figures " + path("empty") + " --out /proc/nowhere", "nowhere"}};
  for (const auto& [arguments, words] : wrong) {
    const Ran result =
        run(arguments + (arguments.find("--out") == std::string::npos ? " --out " + path("o") : ""));
    EXPECT_EQ(result.exit, 2) << arguments;
    EXPECT_NE(result.err.find(words), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_FALSE(fs::exists(path("o")));
  }
}

TEST_F(Cli, ExportLeavesEverythingOfARecordingAndItsSettingsCanBeUsed) {
  const std::string file = simulate("s.capstan", "--trajectory sinusoid --no-images --duration 2");
  const Ran made = run("export " + file + " --size 160x120 --out " + path("out") + " --json -");
  ASSERT_EQ(made.exit, 0) << made.err;
  const json report = json::parse(made.out);
  const std::string index = textOf("out/index.html");
  for (const auto& name : report["files"]) {
    const fs::path written = name.get<std::string>();
    EXPECT_GT(fs::file_size(written), 0U) << written;
    const std::string shown = written.filename().string();
    EXPECT_TRUE(shown == "index.html" || index.find(shown) != std::string::npos) << shown;
  }
  for (const char* name : {"s-joints.pdf", "s-joints.csv", "s-boxplot.svg", "s-report.csv", "truth.yaml"})
    EXPECT_TRUE(fs::exists(path("out/") + name)) << name;
  EXPECT_NE(textOf("out/s-report.csv").find("motor samples,"), std::string::npos);
  const Ran again = run("track " + file + " --estimator-robot " + path("out/robot.yaml") + " --options " +
                        path("out/filter.yaml") + " --json -");
  ASSERT_EQ(again.exit, 0) << again.err;
  EXPECT_EQ(json::parse(again.out)["rms"], json::parse(run("track " + file + " --json -").out)["rms"]);
}

TEST_F(Cli, ExportSaysWhatIsWrongWithItsArguments) {
  const std::pair<std::string, const char*> wrong[] = {{path("none.capstan"), "none.capstan"},
                                                       {"/dev/null --size 88", "--size = 88: is no size"},
                                                       {"/dev/null --out /proc/nowhere", "nowhere"}};
  for (const auto& [arguments, words] : wrong) {
    const Ran result = run("export " + arguments +
                           (arguments.find("--out") == std::string::npos ? " --out " + path("o") : ""));
    EXPECT_EQ(result.exit, 2) << arguments;
    EXPECT_NE(result.err.find(words), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_FALSE(fs::exists(path("o")));
  }
}

}  // namespace
}  // namespace capstan
