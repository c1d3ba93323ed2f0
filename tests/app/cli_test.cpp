/// Runs the real capstan-cli: exit codes, JSON, files, and numbers equal to the library's to the last bit.
#include "core/base/yaml.h"
#include "core/recording/export.h"
#include "core/recording/measured_table.h"
#include "core/recording/session_source.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"
#include "tests/app/cli_fixture.h"
#include "tests/support/folders.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Cli;
using testing::Ran;

TEST_F(Cli, HelpHasExamplesAndSucceeds) {
  for (const char* command : {"simulate", "track", "identify", "calibrate", "info", "convert", "report"}) {
    const Ran help = run(std::string(command) + " --help");
    EXPECT_EQ(help.exit, 0) << command;
    EXPECT_NE(help.out.find("Examples:"), std::string::npos) << command;
    EXPECT_NE(help.out.find("--json"), std::string::npos) << command;
  }
}

TEST_F(Cli, BadUsageIsExitTwoWithOneLineThatSaysWhat) {
  write("bad.csv", "t,q_m1,q_m2,q_m3\n0,1,2,x\n");
  write("there.capstan", "something");
  write("options.yaml", "gate_probability: 3\n");
  const std::string bad = path("bad.csv");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"track " + path("missing.capstan"), "missing.capstan"},
      {"track " + bad, "bad.csv:2"},
      {"track --simulate --no-images --duration 1 --options " + path("options.yaml"), "gate_probability"},
      {"track", "FILE"},
      {"track " + bad + " --simulate", "--simulate"},
      {"track " + bad + " --seed 3", "--simulate"},
      {"track --simulate --trajectory nowhere.csv", "nowhere.csv"},
      {"info " + folder_.string(), "is a folder"},
      {"trak --help", "unknown command trak"},
      {"track --simulate --duration 10s", "--duration = 10s: is not a number"},
      {"track --simulate --seed x", "--seed = x: is not a number"},
      {"track " + bad + " --register " + bad, "bad.csv"},
      {"simulate --out " + path("x.csv"), ".capstan"},
      {"calibrate " + path("nothing"), "nothing"},
      {"calibrate " + folder_.string() + " --board 9by6", "9by6"},
      {"convert " + bad + " " + path("x.what"), "x.what"},
      {"convert " + bad + " " + path("frames") + " --to png", "session"},
      {"simulate --out " + path("there.capstan") + " --no-images --duration 1",
       "exists already. Give another --out, or add --force to overwrite it"}};
  for (const auto& [arguments, word] : cases) {
    const Ran result = run(arguments);
    EXPECT_EQ(result.exit, 2) << arguments;
    EXPECT_NE(result.err.find(word), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << arguments << "\n" << result.err;
    EXPECT_TRUE(result.out.empty()) << arguments;
  }
  EXPECT_EQ(run("").exit, 2);
  EXPECT_EQ(run("track --no-such-option").exit, 2);
}

TEST_F(Cli, ARecordingOfNothingIsExitOne) {
  write("empty.csv", "t,q_m1,q_m2,q_m3\n0,,,\n0.001,,,\n");
  const Ran result = run("track " + path("empty.csv") + " --json -");
  EXPECT_EQ(result.exit, 1) << result.err;
}

TEST_F(Cli, TrackEqualsTheLibraryToTheLastBit) {
  for (const char* more : {"--no-images --duration 4", "--duration 3"}) {
    const std::string file = simulate("a.capstan", "--trajectory sinusoid " + std::string(more) + " --force");
    const Ran result = run("track " + file + " --json -");
    ASSERT_EQ(result.exit, 0) << result.err;
    const json document = json::parse(result.out);
    recording::SessionSource source(file);
    tracking::TrackingPipeline pipeline = tracking::makePipeline(source.info());
    const tracking::TrackReport report = tracking::trackAll(source, pipeline);
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const auto i = static_cast<Eigen::Index>(joint);
      EXPECT_EQ(document["rms"]["kin"][joint].get<double>(), report.errors.kinematic().value()(i));
      EXPECT_EQ(document["rms"]["cam"][joint].get<double>(), report.errors.camera().value()(i));
      EXPECT_EQ(document["rms"]["ukf"][joint].get<double>(), report.errors.ukf().value()(i));
    }
    EXPECT_EQ(document["nis"].get<double>(), report.nisMean());
    EXPECT_EQ(document["samples"].get<std::uint64_t>(), report.motor_samples);
    EXPECT_EQ(run("track " + file + " --json -").out, result.out) << "the same input gives the same document";
  }
}

TEST_F(Cli, SimulatingDirectlyEqualsGoingThroughAFile) {
  const std::string file = simulate("b.capstan", "--trajectory sinusoid --no-images --duration 3");
  const Ran through = run("track " + file + " --json -");
  const Ran direct = run("track --simulate --trajectory sinusoid --seed 9 --no-images --duration 3 --json -");
  ASSERT_EQ(through.exit, 0) << through.err;
  ASSERT_EQ(direct.exit, 0) << direct.err;
  EXPECT_EQ(json::parse(through.out)["rms"], json::parse(direct.out)["rms"]);
}

TEST_F(Cli, JsonToAFileLeavesTheTableOnStandardOutput) {
  const Ran result = run("track --simulate --trajectory sinusoid --no-images --duration 3 --out " +
                         path("e.csv") + " --json " + path("r.json"));
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_NE(result.out.find("q3 [mm]"), std::string::npos);
  EXPECT_TRUE(result.err.empty()) << "no progress off a terminal: " << result.err;
  const json document = json::parse(std::ifstream(path("r.json")));
  for (const char* key : {"rms", "nis", "samples", "gates", "detected"})
    EXPECT_TRUE(document.contains(key)) << key;
  std::ifstream rows(path("e.csv"));
  std::string line;
  std::getline(rows, line);
  EXPECT_EQ(line.rfind("t,camera,t_cam,q_kin1", 0), 0u);
  const auto commas = std::count(line.begin(), line.end(), ',');
  std::uint64_t count = 0;
  while (std::getline(rows, line)) {
    ASSERT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
    ++count;
  }
  EXPECT_EQ(count,
            document["samples"].get<std::uint64_t>() + document["camera_samples"].get<std::uint64_t>());
}

TEST_F(Cli, OcclusionShutsTheGateForItsShare) {
  const Ran result =
      run("track --simulate --trajectory sinusoid --no-images --duration 20 --occlude 40 --json -");
  ASSERT_EQ(result.exit, 0) << result.err;
  const json document = json::parse(result.out);
  const double share =
      document["gates"]["both_lost"].get<double>() / document["camera_samples"].get<double>();
  EXPECT_NEAR(share, 0.4, 0.05);
}

TEST_F(Cli, InfoAndConvertGoRound) {
  const std::string file = simulate("c.capstan", "--trajectory sinusoid --no-images --duration 3");
  const Ran info = run("info " + file + " --json -");
  ASSERT_EQ(info.exit, 0) << info.err;
  const json about = json::parse(info.out);
  EXPECT_EQ(about["kind"], "session");
  EXPECT_TRUE(about["simulated"].get<bool>());

  ASSERT_EQ(run("convert " + file + " " + path("c.csv")).exit, 0);
  const json table = json::parse(run("info " + path("c.csv") + " --json -").out);
  EXPECT_EQ(table["kind"], "table");
  EXPECT_EQ(table["samples"], about["motor"]);
  EXPECT_EQ(table["values"]["q1"], about["joint"]);

  ASSERT_EQ(run("convert " + path("c.csv") + " " + path("again.capstan")).exit, 0);
  ASSERT_EQ(run("convert " + path("again.capstan") + " " + path("again.csv")).exit, 0);
  const auto first = recording::readMeasuredTable(path("c.csv")),
             second = recording::readMeasuredTable(path("again.csv"));
  EXPECT_EQ(first.t, second.t);
  EXPECT_EQ(first.q_m, second.q_m);
  EXPECT_EQ(first.q, second.q);
  EXPECT_EQ(run("convert " + file + " " + path("c.csv")).exit, 2) << "does not overwrite unasked";

  const json robot =
      json::parse(run("info " + test::resourceFile("robots/raven2_left.yaml").string() + " --json -").out);
  EXPECT_EQ(robot["joints"].size(), 3u);
}

TEST_F(Cli, FramesBecomePicturesAndVideo) {
  const std::string file = simulate("d.capstan", "--trajectory hold --duration 0.5");
  const json about = json::parse(run("info " + file + " --json -").out);
  const auto frames = about["frames"].get<std::size_t>();
  ASSERT_GT(frames, 3u);
  ASSERT_EQ(run("convert " + file + " " + path("png") + " --to png").exit, 0);
  EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::directory_iterator(path("png")), {})), 2 * frames);
  ASSERT_EQ(run("convert " + file + " " + path("d.mkv")).exit, 0);
  EXPECT_GT(fs::file_size(path("d.mkv")), 10000u);
}

TEST_F(Cli, ForceKeepsTheFormerFileUntilTheNewOneIsWhole) {
  const std::string former = simulate("f.capstan", "--trajectory hold --no-images --duration 0.5");
  const std::string bytes = textOf("f.capstan");
  write("damaged.csv", "t,q_m1,q_m2,q_m3\n0,1,2,x\n");
  EXPECT_EQ(run("convert " + path("damaged.csv") + " " + former + " --force").exit, 2);
  EXPECT_TRUE(textOf("f.capstan") == bytes);

  const Ran stopped =
      interrupt("simulate --out " + former + " --force --no-images --duration 3600", former + ".part");
  EXPECT_EQ(stopped.exit, 1) << stopped.err;
  EXPECT_EQ(stopped.err, "capstan-cli: cancelled\n");
  EXPECT_TRUE(textOf("f.capstan") == bytes);
  EXPECT_FALSE(fs::exists(former + ".part"));

  EXPECT_EQ(run("simulate --out " + former + " --force --trajectory hold --no-images --duration 1").exit, 0);
  EXPECT_GT(fs::file_size(former), bytes.size());
}

TEST_F(Cli, AnInterruptedImportIsCancelled) {
  std::string table = "t,q_m1,q_m2,q_m3\n";
  for (int row = 0; row < 400000; ++row) table += std::to_string(row * 1e-3) + ",1,2,3\n";
  write("long.csv", table);
  const Ran stopped =
      interrupt("convert " + path("long.csv") + " " + path("l.capstan"), path("l.capstan.part"));
  EXPECT_EQ(stopped.exit, 1) << stopped.err;
  EXPECT_EQ(stopped.err, "capstan-cli: cancelled\n");
  EXPECT_FALSE(fs::exists(path("l.capstan")));
  EXPECT_FALSE(fs::exists(path("l.capstan.part")));
}

TEST_F(Cli, ReportTracksWithTheSessionsOwnOptionsLikeTrack) {
  const std::string plain = simulate("p.capstan", "--trajectory sinusoid --no-images --duration 3");
  {
    recording::SessionSource source(plain);
    tracking::TrackingOptions options;
    options.camera_sigma_floor *= 5.0;
    recording::SessionHeader header = recording::headerOf(source.info(), "2026-11-21");
    header.tracking = base::writeYaml(options);
    recording::importRecording(source, path("own.capstan"), header);
  }
  const auto rmsOf = [&](const std::string& command) {
    const Ran result = run(command + " --json -");
    EXPECT_EQ(result.exit, 0) << result.err;
    return json::parse(result.out)["rms"];
  };
  const json tracked = rmsOf("track " + path("own.capstan"));
  EXPECT_NE(tracked, rmsOf("track " + plain)) << "the options make no difference";
  EXPECT_EQ(rmsOf("report " + path("own.capstan") + " --out " + path("own")), tracked);
}

TEST_F(Cli, BlockedPicturesAreNotCountedAsInView) {
  const std::string command =
      "track --simulate --trajectory hold --truth matched --duration 5 --seed 9 --json - ";
  const json open = json::parse(run(command).out)["centroid"];
  const json blocked = json::parse(run(command + "--occlude 40").out)["centroid"];
  ASSERT_GT(open["in_view"].get<int>(), 100);
  EXPECT_EQ(open["detected"], open["in_view"]);
  EXPECT_EQ(blocked["detected"], blocked["in_view"]);
  EXPECT_NEAR(blocked["in_view"].get<double>() / open["in_view"].get<double>(), 0.6, 0.05);
}

TEST_F(Cli, RegistersAgainAtTheHardStop) {
  const Ran made = run("simulate --out " + path("h.capstan") +
                       " --trajectory hard-stop --truth matched --duration 6 --seed 2");
  ASSERT_EQ(made.exit, 0) << made.err;
  const Ran result = run("track " + path("h.capstan") + " --register hard-stop --save-registration " +
                         path("r.yaml") + " --json -");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_NE(result.err.find("registered at the hard stop"), std::string::npos);
  const Ran again = run("track " + path("h.capstan") + " --register " + path("r.yaml") + " --json -");
  EXPECT_EQ(json::parse(again.out)["rms"], json::parse(result.out)["rms"]);
}

TEST_F(Cli, ReportLeavesAWholeFolderAndReplacesItsOwn) {
  const std::string out = path("report");
  const std::string command = "report --duration 3 --trajectory sinusoid --seed 9 --json - --out " + out;
  const Ran made = run(command);
  ASSERT_EQ(made.exit, 0) << made.err;
  EXPECT_TRUE(made.err.empty()) << made.err;
  for (const char* file :
       {"session.capstan", "joints.png", "joints.pdf", "joints.svg", "joints.csv", "left.png", "right.png",
        "errors.csv", "errors.md", "estimates.csv", "index.html"}) {
    ASSERT_TRUE(fs::exists(fs::path(out) / file)) << file;
    EXPECT_GT(fs::file_size(fs::path(out) / file), 50u) << file;
  }
  const auto text = [&](const std::string& file) {
    std::stringstream all;
    all << std::ifstream(fs::path(out) / file).rdbuf();
    return all.str();
  };
  EXPECT_NE(text("joints.svg").find("time [s]"), std::string::npos);
  EXPECT_NE(text("joints.svg").find("q3 [mm]"), std::string::npos);
  EXPECT_NE(text("index.html").find("simulated"), std::string::npos);
  EXPECT_EQ(text("errors.csv").rfind("estimator,q1_rms_deg,q2_rms_deg,q3_rms_mm\n", 0), 0u);

  const json report = json::parse(made.out);
  const json about = json::parse(run("info " + out + "/session.capstan --json -").out);
  EXPECT_EQ(about["motor"], report["samples"]);
  EXPECT_EQ(about["frames"], report["frames"]);
  const json again = json::parse(run("track " + out + "/session.capstan --json -").out);
  EXPECT_EQ(again["rms"]["kin"], report["rms"]["kin"]) << "what was recorded is what was reported";
  EXPECT_EQ(again["gates"], report["gates"]);
  for (const char* estimator :
       {"cam", "ukf"})  // the rig goes through a camera file, which rounds its last bit
    for (std::size_t joint = 0; joint < 3; ++joint)
      EXPECT_NEAR(again["rms"][estimator][joint].get<double>(), report["rms"][estimator][joint].get<double>(),
                  1e-12);

  EXPECT_EQ(run("report " + out + "/session.capstan --out " + out).exit, 2) << "would replace its own input";
  const Ran of_file = run("report " + out + "/session.capstan --json - --out " + path("second"));
  ASSERT_EQ(of_file.exit, 0) << of_file.err;
  EXPECT_EQ(json::parse(of_file.out)["rms"], again["rms"]);
  EXPECT_FALSE(fs::exists(path("second/session.capstan")));

  write("report/notes.txt", "mine");
  EXPECT_EQ(run(command + " --no-images").exit, 0) << "a former report is replaced";
  EXPECT_FALSE(fs::exists(fs::path(out) / "left.png")) << "of the former report";
  EXPECT_TRUE(fs::exists(fs::path(out) / "notes.txt")) << "not of the report";
  const Ran refused = run("report --duration 1 --no-images --out " + folder_.string());
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.err.find("not empty"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace capstan
