/// What capstan-cli does to files: inputs stay, nothing is replaced unasked, what cannot be written shows.
#include "core/recording/export.h"
#include "core/recording/table_source.h"
#include "tests/app/cli_fixture.h"
#include "tests/support/folders.h"
#include "tests/support/small_disk.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Cli;
using testing::Ran;

class CliFiles : public Cli {
 protected:
  /// Exit 2, one line with `word`.
  void expectRefused(const std::string& arguments, const std::string& word,
                     const std::string& before = {}) const {
    const Ran result = run(arguments, before);
    EXPECT_EQ(result.exit, 2) << arguments << "\n" << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << arguments << "\n" << result.err;
    EXPECT_TRUE(result.out.empty()) << arguments;
  }
  std::string session(const std::string& name) const {
    return simulate(name, "--trajectory hold --no-images --duration 1");
  }
};

TEST_F(CliFiles, AnOutputThatIsAnInputIsRefusedBeforeItIsTouched) {
  const std::string file = session("s.capstan"), bytes = textOf("s.capstan");
  const std::string link = path("link"), hard = path("hard"), robot = path("robot.yaml");
  fs::create_symlink("s.capstan", link);
  fs::create_hard_link(file, hard);
  fs::copy_file(test::resourceFile("robots/raven2_left.yaml"), robot);
  ASSERT_EQ(run("convert " + file + " " + path("t.csv")).exit, 0);
  const std::string table = path("t.csv"), cells = textOf("t.csv"), drawing = textOf("robot.yaml");
  const std::string same = "is the same file as the input";
  for (const std::string& output :
       {file, link, hard, path("./../") + folder_.filename().string() + "/s.capstan"})
    for (const char* option : {"--out", "--json", "--save-registration"})
      expectRefused("track " + file + " " + option + " " + output, same);
  expectRefused("track " + table + " --robot " + robot + " --out " + robot, same);
  expectRefused("track " + table + " --out " + table, same);
  expectRefused("track --simulate --duration 1 --robot " + robot + " --json " + robot, same);
  for (const char* option : {"--out", "--trace", "--json"})
    expectRefused("identify " + table + " " + file + " " + option + " " + file, same);
  expectRefused("info " + file + " --json " + file, same);
  expectRefused("report " + file + " --out " + path("r") + " --json " + file, same);
  expectRefused("convert " + file + " " + hard + " --to table --force", same);
  expectRefused("convert " + file + " " + path("n.csv") + " --json " + file, same);
  expectRefused("simulate --out " + path("n.capstan") + " --robot " + robot + " --json " + robot, same);
  expectRefused("track " + file + " --out " + path("e") + " --json " + path("e"), "is the file of --out too");
  EXPECT_TRUE(textOf("s.capstan") == bytes);
  EXPECT_EQ(textOf("t.csv"), cells);
  EXPECT_EQ(textOf("robot.yaml"), drawing);
}

TEST_F(CliFiles, PlacesThatCannotBeWrittenAreRefusedBeforeTheWork) {
  const std::string file = session("s.capstan"), nowhere = path("nowhere/x");
  // A session that a computation would take hours for.
  const std::string hours = " --simulate --no-images --duration 80000 ";
  for (const std::string& place : {nowhere, std::string("/proc/x")}) {
    for (const char* option : {" --out ", " --json ", " --save-registration "})
      expectRefused("track" + hours + option + place, "cannot be written");
    for (const char* option : {" --out ", " --json ", " --trace "})
      expectRefused("identify" + hours + option + place, "cannot be written");
    expectRefused("simulate --duration 80000 --out " + place + ".capstan", "cannot be written");
    expectRefused("convert " + file + " " + place + ".csv", "cannot be written");
  }
  expectRefused("track" + hours + "--out " + folder_.string(), "is a folder");
  expectRefused("track " + file + " --out - --json -", "is given together with --out -");
  expectRefused("convert " + file + " - --to table", "standard output");
  fs::create_directories(path("pictures"));
  for (const char* name : {"pictures/left1.png", "pictures/right1.png"}) write(name, "no picture");
  expectRefused("calibrate " + path("pictures") + " --out /proc/x", "cannot be written");
  expectRefused("calibrate " + path("pictures") + " --no-write --json " + nowhere, "cannot be written");
  expectRefused("calibrate " + path("pictures") + " --no-write --json " + path("pictures/left1.png"),
                "same file");
  EXPECT_FALSE(fs::exists(path("nowhere")));
}

TEST_F(CliFiles, TheFirstImageOfASessionIsAPngOfTheSize) {
  const std::string file = simulate("s.capstan", "--duration 1");
  const Ran ran = run("info " + file + " --image " + path("first") + " --size 64");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::string png = textOf("first");
  ASSERT_GT(png.size(), 24U);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png[19], 64);  // width, big-endian, in bytes 16 to 19
  expectRefused("info " + session("n.capstan") + " --image " + path("n.png"), "has no images");
}

TEST_F(CliFiles, NothingIsReplacedUnasked) {
  const std::string file = simulate("d.capstan", "--trajectory hold --duration 0.3");
  fs::create_directories(path("full"));
  write("full/mine.txt", "mine");
  for (const char* kind : {"png", "csv-folder"}) {
    expectRefused("convert " + file + " " + path("full") + " --to " + kind, "is not empty");
    EXPECT_EQ(run("convert " + file + " " + path("full") + " --force --to " + kind).exit, 0);
  }
  EXPECT_EQ(textOf("full/mine.txt"), "mine");
  for (const char* name : {"left1.png", "right1.png"}) write(name, "no picture");
  write("right.yaml", "mine");
  expectRefused("calibrate " + folder_.string() + " --out " + folder_.string(), "right.yaml: exists");
}

TEST_F(CliFiles, LinksStayAndTheirTargetsAreWritten) {
  const std::string file = session("s.capstan");
  fs::create_symlink("far.csv", path("link.csv"));
  fs::create_symlink("far.json", path("link.json"));
  ASSERT_EQ(run("track " + file + " --out " + path("link.csv") + " --json " + path("link.json")).exit, 0);
  for (const char* kind : {"csv", "json"}) {
    EXPECT_TRUE(fs::is_symlink(path(std::string("link.") + kind)));
    EXPECT_GT(fs::file_size(path(std::string("far.") + kind)), 100U);
  }
}

TEST_F(CliFiles, PipesStayAndTakeWhatIsWritten) {
  const std::string file = session("s.capstan");
  const std::string readers =
      "cd " + folder_.string() + "; mkfifo csv json; for p in csv json; do timeout 60 cat $p > e.$p & done; ";
  const std::string end = "; exit=$?; wait; exit $exit";
  EXPECT_EQ(run("track " + file + " --out " + path("csv") + " --json " + path("json") + end, readers).exit,
            0);
  for (const char* name : {"csv", "json"}) {
    EXPECT_TRUE(fs::is_fifo(path(name)));
    EXPECT_GT(fs::file_size(path(std::string("e.") + name)), 100U);
  }
}

// A shell that lets no file grow beyond 32 KiB stands for the full disk.
TEST_F(CliFiles, AFullDiskIsNoSuccess) {
  const std::string file = simulate("d.capstan", "--trajectory hold --duration 0.5");
  const std::string full = "trap '' XFSZ; ulimit -f 64; ";
  for (const char* name : {"d.mkv", "d.avi"}) {
    const Ran video = run("convert " + file + " " + path(name), full);
    EXPECT_EQ(video.exit, 2) << name;
    EXPECT_NE(video.err.find("Is the disk full?"), std::string::npos) << video.err;
  }
  EXPECT_EQ(run("track " + file + " --out " + path("e.csv"), full).exit, 2);
  EXPECT_EQ(run("convert " + file + " " + path("t.csv"), full).exit, 2);
  EXPECT_EQ(run("simulate --no-images --duration 1 --out " + path("n.capstan"), full).exit, 2);
  for (const auto& left : fs::directory_iterator(folder_)) {
    const std::string name = left.path().filename().string();
    EXPECT_TRUE(name == "d.capstan" || name == "stderr.txt") << name << " is left";
  }
}

/// The one file, copied away from a disk of 16 MB: whatever fits is in it, and the message says what.
TEST_F(CliFiles, ASimulationOntoAFullDiskIsWholeAsFarAsItWent) {
  const SmallDisk disk(16);
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  for (const char* more : {"--duration 60", "--duration 300 --no-images"}) {
    const fs::path file = disk / "trial.capstan";
    const Ran full = run("simulate --trajectory hold --out " + file.string() + " " + more);
    EXPECT_EQ(full.exit, 2) << full.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(disk.path()), {}), 1) << "nothing else is left";
    ASSERT_TRUE(fs::exists(file)) << full.err;
    fs::copy_file(file, path("copy.capstan"), fs::copy_options::overwrite_existing);
    const json copy = json::parse(run("info --json - " + path("copy.capstan")).out);
    const double length = copy["last_t"].get<double>() - copy["first_t"].get<double>();
    EXPECT_GT(copy["motor"].get<int>(), 500) << full.err;
    EXPECT_NEAR(copy["motor"].get<int>(), 1e3 * length, 20.0);
    const double rate = static_cast<double>(fs::file_size(file)) / length;
    const double room = static_cast<double>(disk.freeBytes()) - (16U << 20) / 10;  // above the reserve
    EXPECT_LT(room, 0.5 * rate) << "half a second more would have fitted";
    std::printf("%s: %.2f s in the copy; %s", more, length, full.err.c_str());
    EXPECT_NE(full.err.find("The file is whole and holds the first"), std::string::npos) << full.err;
    fs::remove(file);
  }
}

TEST_F(CliFiles, AReadOnlyFolderIsRefusedBeforeTheWork) {
  const SmallDisk disk(1);
  if (!disk.mounted() || !disk.makeReadOnly()) GTEST_SKIP() << disk.why();
  const std::string file = simulate("d.capstan", "--trajectory hold --no-images --duration 0.5");
  for (const std::string& command :
       {"simulate --duration 3600 --out " + (disk / "n.capstan").string(),
        "report --duration 3600 --out " + disk.path().string(),
        "report --duration 3600 --out " + (disk / "report").string(),
        "convert " + file + " " + (disk / "t.csv").string(), "experiment A --out " + disk.path().string()}) {
    const Ran ran = run(command);
    EXPECT_EQ(ran.exit, 2) << command;
    EXPECT_NE(ran.err.find(disk.path().string()), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("Read-only"), std::string::npos) << ran.err;
  }
}

TEST_F(CliFiles, StandardOutputThatTakesNothingIsExitOne) {
  const std::string file = session("s.capstan");
  fs::create_symlink("/dev/full", path("full"));
  const Ran result = run("info " + file + " > " + path("full"));
  EXPECT_EQ(result.exit, 1);
  EXPECT_NE(result.err.find("standard output"), std::string::npos) << result.err;
}

TEST_F(CliFiles, TerminationCancelsAndLeavesNothing) {
  const std::string out = path("long.capstan");
  const Ran stopped = interrupt("simulate --no-images --duration 3600 --out " + out, out + ".part", SIGTERM);
  EXPECT_EQ(stopped.exit, 1) << stopped.err;
  EXPECT_EQ(stopped.err, "capstan-cli: cancelled\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "stderr.txt alone";
}

}  // namespace
}  // namespace capstan
