// Robots that send their rows now: standard input and TCP.
#include <fstream>

#include "tests/app/cli_fixture.h"

namespace capstan::testing {
namespace {

class CliLive : public Cli {
 protected:
  /// A recording of some seconds as a measured table.
  std::string makeTable() const {
    EXPECT_EQ(run("simulate --no-images --duration 4 --out " + path("trial.capstan")).exit, 0);
    EXPECT_EQ(run("convert " + path("trial.capstan") + " " + path("trial.csv")).exit, 0);
    return path("trial.csv");
  }
};

TEST_F(CliLive, RowsOnStandardInputAreTrackedAsAFile) {
  const std::string table = makeTable();
  const Ran file = run("track " + table + " --out " + path("file.csv") + " --json -");
  const Ran piped = run("track --live - --out " + path("live.csv") + " --json - <" + table);
  ASSERT_EQ(file.exit, 0) << file.err;
  ASSERT_EQ(piped.exit, 0) << piped.err;
  EXPECT_EQ(textOf("file.csv"), textOf("live.csv"));
  json expected = json::parse(file.out), actual = json::parse(piped.out);
  EXPECT_EQ(actual["title"], "standard input");
  actual["title"] = expected["title"];
  EXPECT_EQ(expected, actual);
}

TEST_F(CliLive, EstimatesOnStandardOutputAreThoseOfTheFile) {
  const std::string table = makeTable();
  ASSERT_EQ(run("track " + table + " --out " + path("file.csv")).exit, 0);
  ASSERT_EQ(run("track " + table + " --out " + path("file.jsonl")).exit, 0);
  const Ran piped = run("track --live - --out - <" + table), recorded = run("track " + table + " --out -");
  ASSERT_EQ(piped.exit, 0) << piped.err;
  EXPECT_EQ(piped.out, textOf("file.csv"));
  EXPECT_EQ(recorded.out, textOf("file.csv"));
  EXPECT_EQ(run("track --live - --out - --out-format jsonl <" + table).out, textOf("file.jsonl"));
  std::istringstream csv(textOf("file.csv")), lines(textOf("file.jsonl"));
  std::string header, row, line;
  std::getline(csv, header);
  for (int i = 0; std::getline(csv, row); ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    const json object = json::parse(line);
    std::istringstream names(header), cells(row);
    for (std::string name, cell; std::getline(names, name, ',');) {
      std::getline(cells, cell, ',');
      if (cell.empty())
        EXPECT_FALSE(object.contains(name)) << name << " in row " << i;
      else if (name == "gate")
        EXPECT_EQ(object[name], cell);
      else
        EXPECT_EQ(object[name].get<double>(), std::stod(cell)) << name << " in row " << i;
    }
  }
}

TEST_F(CliLive, ARowOfALiveSessionIsInTheFileBeforeTheNextOneExists) {
  makeTable();
  // The robot sends 2099 rows and then pauses; the file is looked at in the pause.
  const Ran ran = run("track --live - --out " + path("now.csv") + " >/dev/null",
                      "(head -2100 " + path("trial.csv") + "; sleep 3; wc -l <" + path("now.csv") + " >" +
                          path("lines.txt") + ") | ");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_GE(std::stoi(textOf("lines.txt")), 2099);  // all but the last, which waits for its reference
}

/// A table that is written at once is tracked at the times of its rows, in real time.
TEST_F(CliLive, RowsFasterThanRealTimeKeepTheirTimes) {
  const std::string table = makeTable(), fifo = path("rows.fifo");
  runShell("mkfifo " + fifo);
  const auto lastTime = [](const std::string& text) {
    const std::size_t line = text.rfind('\n', text.size() - 2) + 1;
    return std::stod(text.substr(line));
  };
  const double last = lastTime(textOf("trial.csv"));
  ASSERT_GT(last, 3.5) << "longer than what a session may be ahead by";
  const Ran ran = run("track --live " + fifo + " --duration " + std::to_string(last - 0.1) + " --out " +
                          path("live.csv") + " >/dev/null",
                      "cat " + table + " >" + fifo + " & ");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.err.find("clock stepped"), std::string::npos) << ran.err;
  EXPECT_NEAR(lastTime(textOf("live.csv")), last - 0.1, 0.05);
}

TEST_F(CliLive, EndsAfterItsDurationThoughNoRowsCome) {
  const std::string table = makeTable(), fifo = path("rows.fifo");
  runShell("mkfifo " + fifo);
  const Ran ran = run("track --live " + fifo + " --duration 2 --out " + path("live.csv") + " >/dev/null",
                      "head -500 " + table + " >" + fifo + " & timeout 30 ");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(textOf("live.csv").find("\n0.4"), std::string::npos);
}

/// A misspelled column: no row is accepted, and the duration ends the session all the same.
TEST_F(CliLive, WithoutAnAcceptedRowTheDurationEndsIt) {
  write("rows.csv", "t,q_m1,q_m2,qm3\n0,80,-90,-480\n");
  const std::string port = std::to_string(20000 + getpid() % 20000), at = "tcp://127.0.0.1:" + port;
  const std::string send = "bash -c 'until (exec 3<>/dev/tcp/127.0.0.1/" + port + " && cat " +
                           path("rows.csv") + " >&3 && sleep 1) 2>/dev/null; do sleep 0.2; done'";
  const Ran ran =
      run("record --live " + at + " --duration 1 --out " + path("live.capstan"), send + " & timeout 60 ");
  EXPECT_EQ(ran.exit, 1) << ran.err;
  EXPECT_NE(ran.err.find("qm3: is no column of a measured table; q_m3 is missing"), std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("no row was accepted"), std::string::npos) << ran.err;
  EXPECT_FALSE(fs::exists(path("live.capstan"))) << "an empty session is no recording";
}

TEST_F(CliLive, AFaultOnStandardInputNamesItsLine) {
  const std::string table = makeTable();
  const Ran faulty = run("track --live - ", "sed '1500s/,[^,]*/,oops/' " + table + " | ");
  EXPECT_EQ(faulty.exit, 2);
  EXPECT_NE(faulty.err.find("standard input:1500: q_m1 = oops"), std::string::npos) << faulty.err;
}

TEST_F(CliLive, AMissingRegistrationNamesTheKeyOfTheSetUp) {
  const std::string table = makeTable();
  std::ofstream(path("live.yaml")) << "title: x\nmotors:\n  from: \"-\"\ncameras:\n"
                                   << "  left: http://127.0.0.1:1/both\n  layout: side_by_side\n"
                                   << "  calibration: " << test::resourceFile("cameras").string() << "\n";
  const Ran live = run("track --live " + path("live.yaml") + " <" + table);
  EXPECT_EQ(live.exit, 0) << live.err;
  EXPECT_NE(live.err.find("the live set-up names no registration"), std::string::npos) << live.err;
  EXPECT_NE(live.err.find("`registration:`"), std::string::npos) << live.err;
  EXPECT_EQ(live.err.find("stored with this recording"), std::string::npos) << live.err;
  const Ran record =
      run("record --live " + path("live.yaml") + " --out " + path("live.capstan") + " <" + table);
  EXPECT_NE(record.err.find("the live set-up names no registration"), std::string::npos) << record.err;
}

/// Rows that are there before the recorder is.
TEST_F(CliLive, RowsOnStandardInputAreRecorded) {
  const std::string table = makeTable();
  const Ran record = run("record --live - --out " + path("live.capstan") + " --json - <" + table);
  ASSERT_EQ(record.exit, 0) << record.err;
  const json tracked = json::parse(run("track " + table + " --json -").out);
  EXPECT_EQ(json::parse(record.out)["motor"], tracked["samples"]);
  const json recorded = json::parse(run("track " + path("live.capstan") + " --json -").out);
  EXPECT_EQ(recorded["samples"], tracked["samples"]) << "in the file";
}

TEST_F(CliLive, PlayWaitsForItsReceiverAndNoLonger) {
  const std::string table = makeTable();
  const Ran alone = run("play " + table + " --to tcp://127.0.0.1:1 --wait 0.3");
  EXPECT_EQ(alone.exit, 2);
  EXPECT_NE(alone.err.find("waiting for a program that listens at tcp://127.0.0.1:1"), std::string::npos)
      << alone.err;
  EXPECT_NE(alone.err.find("cannot be connected to"), std::string::npos) << alone.err;
  const Ran images = run("play " + table + " --video http://127.0.0.1:0 --wait 3");
  EXPECT_EQ(images.exit, 2);
  EXPECT_NE(images.err.find("--wait requires --to"), std::string::npos) << images.err;
}

/// `play` is the robot of another process; it waits until the port is open.
TEST_F(CliLive, ARobotOverTcpIsRecorded) {
  const std::string table = makeTable();
  const std::string at = "tcp://127.0.0.1:" + std::to_string(20000 + getpid() % 20000),
                    program = test::commandLineProgram();
  const Ran both = runShell("(sleep 0.5; " + program + " record --live " + at + " --duration 2 --out " +
                            path("live.capstan") + " --json " + path("record.json") + ") & " + program +
                            " play " + table + " --to " + at + " --fault repeat:0.05; wait");
  ASSERT_TRUE(fs::exists(path("record.json"))) << both.err;
  const json record = json::parse(textOf("record.json"));
  EXPECT_EQ(record["lost"], 0);
  EXPECT_EQ(record["dropped"], 0);
  EXPECT_FALSE(record["health"]["checks"].empty()) << record["health"].dump();
  const json side = record["live"][0];
  EXPECT_EQ(side["clock"]["steps"], 0);
  EXPECT_NEAR(side["repeated"], 100, 50);
  EXPECT_NEAR(record["motor"], 2000, 25);
  const Ran tracked = run("track " + path("live.capstan") + " --json -");
  EXPECT_EQ(json::parse(tracked.out)["samples"], record["motor"]);
  const std::string said = run("convert " + path("live.capstan") + " " + path("live.bag")).err;
  if (said.find("needs ROS 1") == std::string::npos) {
    EXPECT_NE(said.find("of the session are excluded: a bag has no topic for them"), std::string::npos)
        << said;
  }
}

/// The same images as in the recording come as two network streams, or as one with both eyes.
TEST_F(CliLive, ARobotWithCamerasIsTracked) {
  ASSERT_EQ(run("simulate --duration 5 --seed 3 --out " + path("trial.capstan")).exit, 0);
  const Ran direct = run("track " + path("trial.capstan") + " --save-registration " +
                         path("registration.yaml") + " --json -");
  ASSERT_EQ(direct.exit, 0) << direct.err;
  const std::string port = std::to_string(20000 + getpid() % 20000),
                    video = "http://127.0.0.1:" + std::to_string(40000 + getpid() % 20000),
                    program = test::commandLineProgram();
  for (const std::string& streams : {"left: " + video + "/left\n  right: " + video + "/right",
                                     "left: " + video + "/both\n  layout: side_by_side"}) {
    std::ofstream(path("live.yaml")) << "title: two cameras\nmotors:\n  from: tcp://127.0.0.1:" << port
                                     << "\ncameras:\n  " << streams
                                     << "\n  calibration: " << test::resourceFile("cameras").string()
                                     << "\n  registration: registration.yaml\n  latency: 0\n";
    fs::remove(path("track.json"));
    const Ran both =
        runShell("(" + program + " track --live " + path("live.yaml") + " --duration 4.8 --json " +
                 path("track.json") + ") & until " + program + " play " + path("trial.capstan") +
                 " --to tcp://127.0.0.1:" + port + " --video " + video + "; do sleep 0.1; [ -e " +
                 path("track.json") + " ] && break; done; wait");
    ASSERT_TRUE(fs::exists(path("track.json"))) << both.err;
    const json tracked = json::parse(textOf("track.json"));
    const json motors = tracked["live"][0], cameras = tracked["live"][1];
    EXPECT_EQ(motors["dropped"], 0);
    EXPECT_EQ(cameras["dropped"], 0);
    EXPECT_TRUE(cameras["clock"].is_null());
    const int frames = tracked["frames"];
    EXPECT_GT(frames, 15) << "of 72; on a busy machine the streams take seconds to open";
    EXPECT_EQ(tracked["detected"][0], frames);
    EXPECT_EQ(tracked["detected"][1], frames);
    EXPECT_EQ(both.err.find("tcp @"), std::string::npos) << "FFmpeg is silent: " << both.err;
  }
}

/// Images go on while nobody takes the rows; who listens later gets the rows of then.
TEST_F(CliLive, PlayGoesOnWhenTheReceiverOfTheRowsEnds) {
  ASSERT_EQ(run("simulate --duration 6 --seed 3 --out " + path("trial.capstan")).exit, 0);
  const std::string at = "tcp://127.0.0.1:" + std::to_string(20000 + getpid() % 20000),
                    program = test::commandLineProgram(), track = program + " track --live " + at;
  const Ran both =
      runShell("(" + track + " --duration 1; sleep 1; " + track + " --duration 1 --json " +
               path("second.json") + ") >/dev/null & until " + program + " play " + path("trial.capstan") +
               " --to " + at + " --video http://127.0.0.1:0 --json " + path("play.json") +
               "; do sleep 0.1; [ -e " + path("play.json") + " ] && break; done; wait");
  ASSERT_TRUE(fs::exists(path("play.json"))) << both.err;
  const json played = json::parse(textOf("play.json")), second = json::parse(textOf("second.json"));
  const json info = json::parse(run("info " + path("trial.capstan") + " --json -").out);
  EXPECT_EQ(played["images"]["sent"].get<int>() + played["images"]["skipped"].get<int>(), info["frames"])
      << "to the end";
  EXPECT_GE(played["connections"], 2);
  EXPECT_GT(played["lost"], 500);
  EXPECT_EQ(played["sent"].get<int>() + played["lost"].get<int>(), played["rows"]);
  EXPECT_NEAR(second["samples"], 1000, 50);
}

/// Left and right exchanged: said by the time that a blink has passed, and for as long as it lasts.
TEST_F(CliLive, ExchangedCamerasAreNamed) {
  ASSERT_EQ(run("simulate --duration 7 --seed 3 --out " + path("trial.capstan")).exit, 0);
  ASSERT_EQ(run("track " + path("trial.capstan") + " --save-registration " + path("registration.yaml")).exit,
            0);
  const std::string port = std::to_string(20000 + getpid() % 20000),
                    video = "http://127.0.0.1:" + std::to_string(40000 + getpid() % 20000),
                    program = test::commandLineProgram();
  write("live.yaml", "title: two cameras\nmotors:\n  from: tcp://127.0.0.1:" + port +
                         "\ncameras:\n  left: " + video + "/left\n  right: " + video +
                         "/right\n  calibration: " + test::resourceFile("cameras").string() +
                         "\n  registration: registration.yaml\n  latency: 0\n");
  const Ran both = runShell("(" + program + " track --live " + path("live.yaml") + " --duration 6.8 --json " +
                            path("track.json") + ") & until " + program + " play " + path("trial.capstan") +
                            " --to tcp://127.0.0.1:" + port + " --video " + video +
                            " --video-fault swap:2@4 2>/dev/null; do sleep 0.1; [ -e " + path("track.json") +
                            " ] && break; done; wait");
  ASSERT_TRUE(fs::exists(path("track.json"))) << both.err;
  const json gates = json::parse(textOf("track.json"))["gates"];
  EXPECT_GT(gates["cameras_exchanged"], 15)
      << "of 30 pairs; on a busy machine the streams take seconds to open";
  EXPECT_NE(both.err.find("camera not used: left and right camera exchanged"), std::string::npos) << both.err;
}

TEST_F(CliLive, BadAddressesAndFaultsAreRefused) {
  write("nothing", "");
  for (const auto& [arguments, words] :
       {std::pair{"track --live tcp://robot:5555", "no IPv4 address"},
        {"track --live tcp://127.0.0.1:5555 trial.csv", "together with FILE"},
        {"track --live nowhere.yaml", "nowhere.yaml"},
        {"track --live - --register hard-stop", "read twice"},
        {"track --live - --out trial.h5", "Estimates are CSV or JSON Lines"},
        {"track trial.csv --out tcp://127.0.0.1:5556", "without --live"},
        {"track --live - --out - --json -", "together with --out -"},
        {"play trial.csv --to rows.fifo", "no TCP address"},
        {"play trial.csv --to tcp://127.0.0.1:5555 --fault storm", "names no fault"},
        {"play trial.csv", "is missing, and so is --video"},
        {"play trial.csv --video 127.0.0.1:8081", "does not begin with http://"},
        {"play trial.csv --to tcp://127.0.0.1:5555 --video-fault swap:1@1", "needs --video"},
        {"play trial.csv --video http://127.0.0.1:8081 --fault drop:0.1", "needs --to"},
        {"record --live - --out trial.csv", "does not end in .capstan"}}) {
    const Ran ran = run(arguments, "<" + path("nothing") + " ");
    EXPECT_EQ(ran.exit, 2) << arguments;
    EXPECT_NE(ran.err.find(words), std::string::npos) << arguments << ": " << ran.err;
  }
  write("there.capstan", "");
  const Ran ran = run("record --live tcp://127.0.0.1:0 --out " + path("there.capstan"));
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("exists already"), std::string::npos) << ran.err;
  EXPECT_EQ(ran.err.find("waiting"), std::string::npos) << "said before anything is waited for: " << ran.err;
}

}  // namespace
}  // namespace capstan::testing
