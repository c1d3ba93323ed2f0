// The command behind its options, with a stand-in for the engine: what it hands on, writes and refuses.
#include "app/cli/diagnose_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "tests/app/diagnose_recording.h"
#include "tests/core/diagnosis/sampled_poses.h"

namespace capstan::cli {
namespace {

namespace fs = std::filesystem;
using diagnosis::Evidence;
using diagnosis::Report;
using diagnosis::Verdict;
using testing::sampleReport;

class DiagnoseRun : public ::testing::Test {
 protected:
  DiagnoseRun() : folder_(fs::temp_directory_path() / ("capstan_diagnose_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    testing::writeRecording(path("slow.csv"), {.duration = 8.0});
    testing::writeRecording(path("fast.csv"), {.duration = 8.0}, 1);
    arguments_.files = {path("slow.csv")};
  }
  ~DiagnoseRun() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Standard output is kept in out_, standard error in err_.
  ExitCode run() {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    ExitCode exit = kUsage;
    std::exception_ptr failure;
    try {
      exit = runDiagnose(arguments_, [this](const auto& recordings, const auto& robot, const auto& options,
                                            base::Progress* progress) {
        ++asked_;
        recordings_ = recordings, robot_ = robot, options_ = options;
        if (cancel_) progress->cancel();
        return report_;
      });
    } catch (...) {
      failure = std::current_exception();
    }
    out_ = ::testing::internal::GetCapturedStdout();
    err_ = ::testing::internal::GetCapturedStderr();
    if (failure) std::rethrow_exception(failure);
    return exit;
  }
  /// What the refusal says; it comes before anything is computed.
  std::string refusal() {
    try {
      run();
    } catch (const base::InputError& error) {
      EXPECT_EQ(asked_, 0) << "refused too late";
      return error.what();
    }
    ADD_FAILURE() << "not refused";
    return {};
  }
  void expectRefusal(std::initializer_list<const char*> parts) {
    const std::string words = refusal();
    for (const char* part : parts) EXPECT_NE(words.find(part), std::string::npos) << words;
  }

  fs::path folder_;
  DiagnoseArguments arguments_;
  Report report_ = sampleReport({.duration = 8.0});
  bool cancel_ = false;
  int asked_ = 0;
  std::vector<Evidence> recordings_;
  robot::Description robot_;
  diagnosis::DiagnosisOptions options_;
  std::string out_, err_;
};

TEST_F(DiagnoseRun, HandsOnRecordingsRobotAndOptions) {
  arguments_.files.push_back(path("fast.csv"));
  arguments_.skip_start = 2.0;
  arguments_.options.only = {"backlash", "slack"};
  arguments_.options.threads = 1;
  arguments_.zeros = "shared";
  arguments_.material = "3mm";
  EXPECT_EQ(run(), kOk);
  ASSERT_EQ(recordings_.size(), 2U);
  EXPECT_EQ(recordings_[0].rows(), 800U);
  EXPECT_EQ(recordings_[0].q[1], testing::sampleEvidence({.duration = 8.0}).q[1]);
  EXPECT_FALSE(recordings_[0].counts(199)) << "skipped";
  EXPECT_TRUE(recordings_[0].counts(201));
  EXPECT_EQ(robot_.name, "RAVEN-II left");
  EXPECT_EQ(options_.only, arguments_.options.only);
  EXPECT_EQ(options_.threads, 1);
  EXPECT_EQ(options_.zeros, diagnosis::EncoderZeros::kOneForAll);
  EXPECT_NEAR(options_.material.length, 3e-3, 1e-15);
  EXPECT_EQ(options_.material.angle, diagnosis::Tolerance{}.angle);
  EXPECT_NE(out_.find(report_.summary.substr(0, 40)), std::string::npos) << out_;
  EXPECT_NE(err_.find(report_.notices[0]), std::string::npos) << err_;
}

TEST_F(DiagnoseRun, TheRobotFileGivenIsTheNominalOne) {
  robot::Description other = report_.extended;
  other.name = "another";
  base::writeTextFile(path("other.yaml"), robot::formatDescription(other));
  arguments_.robot = path("other.yaml");
  EXPECT_EQ(run(), kOk);
  EXPECT_EQ(robot_.name, "another");
}

TEST_F(DiagnoseRun, JsonOnStandardOutputIsAllThatIsThere) {
  arguments_.json = "-";
  EXPECT_EQ(run(), kOk);
  const auto document = nlohmann::json::parse(out_);
  EXPECT_EQ(document.at("verdict"), "found");
  EXPECT_EQ(document.at("causes")[0].at("joint"), 2);
}

TEST_F(DiagnoseRun, WritesTheExtendedRobotAndSaysWhereItIsFrom) {
  arguments_.out = path("extended.yaml");
  EXPECT_EQ(run(), kOk);
  EXPECT_EQ(base::readTextFile(path("extended.yaml")).rfind("# Extended by a diagnosis of slow.csv", 0), 0U);
  EXPECT_EQ(robot::formatDescription(robot::readDescription(path("extended.yaml"))),
            robot::formatDescription(report_.extended));
  report_ = sampleReport({.verdict = Verdict::kNothing, .duration = 8.0});
  EXPECT_EQ(run(), kOk) << "an answer, too";
  EXPECT_NE(err_.find("nothing was named"), std::string::npos) << err_;
}

TEST_F(DiagnoseRun, WritesAPage) {
  arguments_.report = path("page");
  EXPECT_EQ(run(), kOk);
  for (const char* name : {"index.html", "report.json", "robot.yaml", "q2-residual.svg", "q2-signatures.svg"})
    EXPECT_TRUE(fs::exists(folder_ / "page" / name)) << name;
  EXPECT_NE(out_.find("index.html"), std::string::npos);
  EXPECT_NE(base::readTextFile(path("page/index.html")).find("RAVEN-II left"), std::string::npos);
}

TEST_F(DiagnoseRun, WritesTheTrajectoryOfTheNextExperiment) {
  arguments_.next = path("next.csv");
  EXPECT_EQ(run(), kOk);
  EXPECT_FALSE(fs::exists(path("next.csv")));
  EXPECT_NE(err_.find("no experiment is proposed"), std::string::npos) << err_;
  report_.next = {.motion = "joint 2 sweeps slowly, the other joints rest",
                  .distinguishes = {{"backlash", 2}},
                  .t = {0.0, 0.01},
                  .q = {{0.1, 0.1}, {0.2, 0.25}, {0.3, 0.3}},
                  .confusion_now = 0.4,
                  .confusion_after = 0.002};
  arguments_.report = path("page");
  EXPECT_EQ(run(), kOk);
  EXPECT_EQ(base::readTextFile(path("next.csv")), "t,q1,q2,q3\n0.0000,0.1,0.2,0.3\n0.0100,0.1,0.25,0.3\n");
  EXPECT_NE(out_.find("joint 2 sweeps slowly"), std::string::npos) << out_;
  EXPECT_NE(out_.find("from 40.0 % to 0.2 %"), std::string::npos) << out_;
  EXPECT_TRUE(fs::exists(folder_ / "page" / "next-experiment.csv"));
  EXPECT_NE(base::readTextFile(path("page/index.html")).find("joint 2 sweeps slowly"), std::string::npos);
  const auto json = nlohmann::json::parse(base::readTextFile(path("page/report.json"))).at("next_experiment");
  EXPECT_EQ(json.at("distinguishes").at(0).at("effect"), "backlash");
  EXPECT_EQ(json.at("confusion_after"), 0.002);
}

TEST_F(DiagnoseRun, CancelledWritesNoRobotAndNoPage) {
  cancel_ = true;
  report_.cancelled = true;
  arguments_.out = path("extended.yaml");
  arguments_.report = path("page");
  EXPECT_EQ(run(), kFailed);
  EXPECT_FALSE(fs::exists(path("extended.yaml")));
  EXPECT_FALSE(fs::exists(path("page")));
  EXPECT_NE(err_.find("not written: " + path("extended.yaml") + ", " + path("page")), std::string::npos)
      << err_;
  EXPECT_NE(out_.find("no verdict"), std::string::npos) << out_;
  EXPECT_NE(out_.find("model by model"), std::string::npos) << "what there was is said";
  EXPECT_EQ(out_.find(report_.summary.substr(0, 40)), std::string::npos) << "half of the work is no answer";
  report_ = {};
  report_.cancelled = true;
  EXPECT_EQ(run(), kFailed);
  EXPECT_TRUE(out_.empty());
  EXPECT_NE(err_.find("nothing was diagnosed"), std::string::npos) << err_;
}

/// In a process of its own: the program keeps in mind that it was interrupted.
TEST_F(DiagnoseRun, CtrlCReachesTheEngine) {
  arguments_.out = path("extended.yaml");
  const auto interrupted = [&] {
    std::exit(runDiagnose(arguments_, [](const auto&, const auto&, const auto&, base::Progress* progress) {
      std::raise(SIGINT);
      while (!progress->cancelled()) usleep(1000);
      Report report;
      report.cancelled = true;
      return report;
    }));
  };
  EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(kFailed),
              "cancelled: nothing was diagnosed; not written");
  EXPECT_FALSE(fs::exists(path("extended.yaml")));
}

TEST_F(DiagnoseRun, RefusesRecordingsThatWillNotDo) {
  arguments_.files = {path("none.csv")};
  expectRefusal({"none.csv", "does not exist"});
  fs::copy_file(path("slow.csv"), path("copy.csv"));
  arguments_.files = {path("slow.csv"), path("copy.csv")};
  expectRefusal({"copy.csv", "same recording as", "slow.csv"});
  base::writeTextFile(path("robot.yaml"), robot::formatDescription(report_.extended));
  arguments_.files = {path("robot.yaml")};
  expectRefusal({"robot.yaml", "no recording", "--robot"});
  base::writeTextFile(path("short.csv"), "t,q_m1,q1\n0,0,0\n0.01,0,0\n");
  arguments_.files = {path("short.csv")};
  expectRefusal({"short.csv"});
}

TEST_F(DiagnoseRun, RefusesARobotOfOtherJoints) {
  robot::Description two = report_.extended;
  two.joints.pop_back(), two.drives.pop_back(), two.coupling.pop_back(), two.wrist.clear();
  for (auto& row : two.coupling) row.pop_back();
  base::writeTextFile(path("two.yaml"), robot::formatDescription(two));
  arguments_.robot = path("two.yaml");
  expectRefusal({"slow.csv", "joint", "2"});
  arguments_.robot = path("none.yaml");
  expectRefusal({"none.yaml"});
}

TEST_F(DiagnoseRun, RefusesUnknownEffectsAndOutputsThatWillNotDo) {
  arguments_.options.only = {"backlash", "gremlins"};
  expectRefusal({"--only", "gremlins", "cable_hysteresis"});
  arguments_.options.only.clear();
  arguments_.out = path("slow.csv");
  expectRefusal({"--out", "is the same file as the input"});
  arguments_.out.clear();
  fs::create_directories(path("mine"));
  base::writeTextFile(path("mine/notes.txt"), "mine");
  arguments_.report = path("mine");
  expectRefusal({"mine", "former report"});
}

TEST_F(DiagnoseRun, TipPosesAreDiagnosedWithoutMotors) {
  diagnosis::testing::PoseWorld world{.trajectories = 30};
  world.offset.z() = 0.004;
  base::writeTextFile(path("poses.csv"), diagnosis::testing::poseTable(world));
  arguments_.files = {path("poses.csv")};
  arguments_.out = path("extended.yaml");
  arguments_.report = path("page");
  EXPECT_EQ(run(), kOk);
  EXPECT_EQ(asked_, 0) << "there is nothing to simulate";
  for (const char* part : {"Cameras registered with an offset", "step by step", "verdict: found"})
    EXPECT_NE(out_.find(part), std::string::npos) << part << " in\n" << out_;
  EXPECT_NE(err_.find("poses.csv: "), std::string::npos) << err_;
  EXPECT_EQ(robot::readDescription(path("extended.yaml")).effects.at(0).effect, "camera_offset");
  EXPECT_TRUE(fs::exists(folder_ / "page" / "tip-z-residual.svg"));
  arguments_.out = arguments_.report = {};
  arguments_.towards = "command";
  arguments_.json = "-";
  EXPECT_EQ(run(), kOk);
  EXPECT_EQ(nlohmann::json::parse(out_).at("towards"), "command");
}

TEST_F(DiagnoseRun, RefusesWhatPosesAndOtherRecordingsDoNotShare) {
  base::writeTextFile(path("poses.csv"), diagnosis::testing::poseTable({.trajectories = 2}));
  arguments_.files = {path("slow.csv"), path("poses.csv")};
  expectRefusal({"poses.csv", "tip poses", "by itself"});
  arguments_.files = {path("poses.csv")};
  arguments_.skip_start = 1.0;
  expectRefusal({"--skip-start"});
  arguments_.skip_start = 0.0;
  arguments_.next = path("next.csv");
  expectRefusal({"--next", "next.csv"});
  arguments_.next = {};
  arguments_.zeros = "shared";
  expectRefusal({"--zeros", "shared"});
  arguments_.zeros = {};
  arguments_.files = {path("slow.csv")};
  arguments_.towards = "command";
  expectRefusal({"--towards", "tip poses"});
}

}  // namespace
}  // namespace capstan::cli
