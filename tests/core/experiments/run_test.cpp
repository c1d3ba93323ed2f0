#include "core/experiments/run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/results_json.h"
#include "core/experiments/series.h"
#include "core/recording/export.h"
#include "core/simulation/simulation_request.h"
#include "tests/support/folders.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kTracking =
    "name: small\nwork: track\ntitle: two short trials\nimages: false\ntrials:\n"
    "  - {name: free, trajectory: sinusoid, duration: 3, seed: 4}\n"
    "  - {name: half, trajectory: sinusoid, duration: 4, seed: 5, occlusion: {percentage: 50, interval: "
    "1}}\n";

class Experiments : public ::testing::Test {
 protected:
  Experiments() : folder_(fs::temp_directory_path() / ("capstan_experiments_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Experiments() override { fs::remove_all(folder_); }

  Results runIn(const std::string& out, const Specification& specification, int threads = 2) const {
    base::Progress progress;
    return run(specification, {.out = folder_ / out, .threads = threads, .software = "test"}, progress);
  }
  Specification tracking() const { return parseSpecification(kTracking, folder_ / "small.yaml"); }
  /// Every file of a folder of results but timing, the trials' own and those of subfolders.
  std::map<std::string, std::string> filesOf(const std::string& out) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_ / out))
      if (entry.is_regular_file() && entry.path().filename() != "timing.json")
        files[entry.path().filename()] = base::readTextFile(entry.path());
    return files;
  }

  fs::path folder_;
};

TEST_F(Experiments, TrialsAreTrackedAndKept) {
  const Results results = runIn("one", tracking());
  ASSERT_EQ(results.trials.size(), 2U);
  EXPECT_TRUE(results.simulated);
  EXPECT_FALSE(results.cancelled);
  const TrialResult& free = results.trials[0];
  const TrialResult& half = results.trials[1];
  EXPECT_EQ(free.name, "free");
  EXPECT_EQ(free.seed, 4U);
  EXPECT_FALSE(free.images);
  EXPECT_NEAR(free.duration(), 3.0, 0.5);
  EXPECT_EQ(free.occluded_share, 0.0);
  EXPECT_NEAR(half.occluded_share, 0.5, 0.06);
  EXPECT_NEAR(static_cast<double>(free.errors.size()), 100.0 * free.duration(), 3.0);
  EXPECT_NEAR(static_cast<double>(free.trajectory.size()), 20.0 * free.duration(), 2.0);
  // Thinned errors are those of the trajectory where both have a point, and their RMS is nearly the whole
  // one.
  for (std::size_t i = 0; i < free.trajectory.size(); ++i) {
    const TrajectoryPoint& point = free.trajectory[i];
    const ErrorPoint& error = free.errors[5 * i];
    ASSERT_EQ(error.t, point.t);
    EXPECT_LT((point.q_ukf - point.q_true - error.ukf).norm(), 3e-9);
    EXPECT_LT((point.q_kin - point.q_true - error.kinematic).norm(), 3e-9);
  }
  double sum = 0.0;
  for (const double e : free.errorsOf(Estimator::kKinematic, 0)) sum += e * e;
  const double whole = free.rmsOf(Estimator::kKinematic)(0);
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(free.errors.size())), whole, 0.02 * whole);
  // The estimator assumes the nominal robot here: both kinematics are one.
  EXPECT_EQ(free.rmsOf(Estimator::kKinematic), free.rmsOf(Estimator::kIdentified));
  EXPECT_THAT(free.inputs.truth, HasSubstr("name: default"));

  const Results read = readResults(folder_ / "one" / "small");
  EXPECT_EQ(headOf(read), headOf(results));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(numbersOf(read.trials[i]).dump(), numbersOf(results.trials[i]).dump());
    EXPECT_EQ(seriesOf(read.trials[i]).dump(), seriesOf(results.trials[i]).dump());
  }
}

// The README's specification is the one that people copy.
TEST_F(Experiments, TheReadmesExampleRuns) {
  const std::string readme = base::readTextFile(test::sourceFile("README.md"));
  const std::string fence = "```yaml\n";
  const std::size_t begin = readme.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t end = readme.find("```", begin + fence.size());
  const std::string text = readme.substr(begin + fence.size(), end - begin - fence.size());
  const Results results = runIn("out", parseSpecification(text, folder_ / "mine.yaml"));
  ASSERT_EQ(results.trials.size(), 2U);
  EXPECT_NEAR(results.trials[0].duration(), 20.0, 1.0);
  EXPECT_NEAR(results.trials[1].occluded_share, 0.5, 0.06);
  EXPECT_TRUE(results.trials[0].reference);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "mine" / "results.json"));
}

TEST_F(Experiments, ThreadsDoNotChangeTheResult) {
  (void)runIn("one", tracking(), 1);
  (void)runIn("two", tracking(), 2);
  EXPECT_EQ(filesOf("one/small"), filesOf("two/small"));
}

TEST_F(Experiments, AnInterruptedRunGoesOnToTheSameBytes) {
  std::string text = "name: small\nwork: track\nimages: false\ntrials:\n";
  for (int i = 0; i < 6; ++i)
    text += fmt::format("  - {{name: t{0}, trajectory: sinusoid, duration: {1}, seed: {0}}}\n", i,
                        i == 2 ? 3 : 2);
  const Specification many = parseSpecification(text, folder_ / "small.yaml");
  (void)runIn("whole", many);
  base::Progress progress;
  const RunOptions options{.out = folder_ / "parts", .threads = 1, .software = "test"};
  {
    // One thread takes trials in their order; once the third is kept, cancel.
    std::jthread stopper([&](const std::stop_token& stop) {
      while (!fs::exists(options.out / "small" / "trials" / "t2.json") && !stop.stop_requested())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      progress.cancel();
    });
    const Results stopped = run(many, options, progress);
    stopper.request_stop();
    ASSERT_TRUE(stopped.cancelled);
    EXPECT_GE(stopped.kept, 3);
    for (const char* first : {"t0.json", "t1.json"})
      EXPECT_TRUE(fs::exists(options.out / "small" / "trials" / first)) << first;
  }
  EXPECT_FALSE(fs::exists(options.out / "small" / "results.json"));
  const Results resumed = runIn("parts", many);
  EXPECT_GE(resumed.resumed, 3);
  EXPECT_LT(resumed.resumed, 6);
  EXPECT_EQ(filesOf("parts/small"), filesOf("whole/small"));
}

TEST_F(Experiments, OnlyWhatChangedIsRunAgain) {
  (void)runIn("one", tracking());
  EXPECT_EQ(runIn("one", tracking()).resumed, 2);
  std::string text = kTracking;
  text.replace(text.find("seed: 4"), 7, "seed: 6");
  EXPECT_EQ(runIn("one", parseSpecification(text, folder_ / "small.yaml")).resumed, 1);
}

TEST_F(Experiments, ADamagedTrialIsNamedAndRunAgain) {
  const Results whole = runIn("one", tracking());
  const auto files = filesOf("one/small");
  const fs::path trial = folder_ / "one" / "small" / "trials" / "free.json";
  std::string text = base::readTextFile(trial);
  const std::size_t digit = text.find("\"rms\":[[") + 12;
  text[digit] = text[digit] == '1' ? '2' : '1';
  for (const std::string& damaged : {text, text.substr(0, text.size() / 2), std::string()}) {
    std::ofstream(trial, std::ios::binary) << damaged;
    const Results again = runIn("one", tracking());
    ASSERT_EQ(again.notices.size(), 1U);
    EXPECT_THAT(again.notices.front(), HasSubstr("free.json"));
    EXPECT_EQ(again.resumed, 1);
    EXPECT_EQ(filesOf("one/small"), files);
  }
}

TEST_F(Experiments, RecordedSessionsGoThroughTheSameRunner) {
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.duration = 3.0;
  request.seed = 4;
  request.images = false;
  simulation::SimulatedSource source(simulation::optionsOf(request));
  recording::importRecording(source, folder_ / "recorded.capstan", recording::headerOf(source.info(), "now"));
  const Results recorded =
      runIn("recorded", parseSpecification("name: mine\nwork: track\ntrials:\n"
                                           "  - {name: recorded, recording: recorded.capstan}\n",
                                           folder_ / "mine.yaml"));
  const Results simulated = runIn("simulated", tracking());
  ASSERT_EQ(recorded.trials.size(), 1U);
  for (std::size_t i = 0; i < kEstimators; ++i)
    EXPECT_EQ(recorded.trials[0].rms[i], simulated.trials[0].rms[i]);
  EXPECT_TRUE(seriesOf(recorded.trials[0]).dump() == seriesOf(simulated.trials[0]).dump());
  EXPECT_THAT(recorded.trials[0].inputs.recording,
              ::testing::MatchesRegex("recorded.capstan, [0-9]+ bytes, checksum " +
                                      base::checksumOfFile(folder_ / "recorded.capstan")));
}

// What is identified keeps its motion: that of the filter which collected the data, as if it had been
// tracked.
TEST_F(Experiments, IdentificationsKeepTheMotionOfTheirTrials) {
  const std::string trials =
      "trials:\n  - {name: free, trajectory: sinusoid, duration: 6, seed: 4}\n"
      "  - {name: half, trajectory: sinusoid, duration: 6, seed: 5, occlusion: "
      "{percentage: 50, interval: 1}}\n";
  const Specification find = parseSpecification(
      "name: find\nwork: identify\nimages: false\nidentification: {parameters: r_l}\n" + trials,
      folder_ / "find.yaml");
  const Results found = runIn("out", find);
  const Results tracked = runIn(
      "out", parseSpecification("name: track\nwork: track\nimages: false\n" + trials, folder_ / "t.yaml"));
  ASSERT_TRUE(found.identification);
  ASSERT_EQ(found.identification->motions.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const TrialMotion& motion = found.identification->motions[i];
    const TrialResult& trial = tracked.trials[i];
    EXPECT_EQ(motion.name, trial.name);
    EXPECT_EQ(motion.begin, trial.begin);
    EXPECT_EQ(motion.end, trial.end);
    EXPECT_EQ(motion.occluded_share, trial.occluded_share);
    EXPECT_GT(motion.trajectory.size(), 100U);
    EXPECT_FALSE(motion.camera.empty());
    EXPECT_TRUE(csvOfSeries(motion.trajectory) == csvOfSeries(trial.trajectory)) << i;
    EXPECT_TRUE(csvOfSeries(motion.camera) == csvOfSeries(trial.camera)) << i;
  }
  EXPECT_TRUE(base::readTextFile(folder_ / "out" / "find" / "half-trajectory.csv") ==
              csvOfSeries(tracked.trials[1].trajectory));

  const Results read = readResults(folder_ / "out" / "find");
  EXPECT_EQ(numbersOf(*read.identification).dump(), numbersOf(*found.identification).dump());
  EXPECT_TRUE(seriesOf(*read.identification).dump() == seriesOf(*found.identification).dump());
  const auto files = filesOf("out/find");
  EXPECT_EQ(runIn("out", find).resumed, 2);
  EXPECT_TRUE(filesOf("out/find") == files);
}

TEST_F(Experiments, TheIdentifiedRobotIsTrackedAndThePlantStays) {
  std::ofstream(folder_ / "find.yaml") << "name: find\nwork: identify\nimages: false\n"
                                          "identification: {parameters: r_l}\ntrials:\n"
                                          "  - {name: sinusoid, trajectory: sinusoid, duration: 25}\n";
  std::ofstream(folder_ / "use.yaml") << "name: use\nwork: track\nimages: false\nrobot: [find]\ntrials:\n"
                                         "  - {name: free, trajectory: sinusoid, duration: 3, seed: 4}\n";
  const Results used = runIn("out", readSpecification(folder_ / "use.yaml"));
  const Results found = readResults(folder_ / "out" / "find");
  ASSERT_TRUE(found.identification);
  ASSERT_EQ(found.identification->parameters.size(), 3U);
  const IdentifiedParameter& radius = found.identification->parameters[0];
  EXPECT_EQ(radius.name, "r_l1");
  EXPECT_NEAR(radius.truth, 0.059, 1e-12);
  EXPECT_NEAR(radius.dual_ukf.value, radius.truth, 0.005 * radius.truth);
  EXPECT_NEAR(radius.batch.value, radius.truth, 0.005 * radius.truth);
  EXPECT_FALSE(found.identification->trace.empty());
  EXPECT_THAT(found.identification->robot,
              HasSubstr("# Identified from trial sinusoid (simulated, seed 1), 2"));
  EXPECT_THAT(found.identification->robot, HasSubstr("by the dual-ukf method of test; value"));
  EXPECT_THAT(found.identification->robot, HasSubstr("#   r_l1 5"));
  (void)robot::readDescription(folder_ / "out" / "find" / "robot.yaml");
  // The last point of the trace is half a second older than the result at most.
  const ParameterTracePoint& last = found.identification->trace.back();
  EXPECT_LT(std::abs(last.value[0] - radius.dual_ukf.value), last.sigma[0]);

  const Results nominal = runIn("nominal", tracking());
  const TrialResult& with = used.trials[0];
  const TrialResult& without = nominal.trials[0];
  EXPECT_EQ(with.rmsOf(Estimator::kKinematic), without.rmsOf(Estimator::kKinematic));  // one plant
  EXPECT_LT(with.rmsOf(Estimator::kIdentified)(0), 0.3 * with.rmsOf(Estimator::kKinematic)(0));
  EXPECT_LT(with.rmsOf(Estimator::kUkf)(0), without.rmsOf(Estimator::kUkf)(0));
  EXPECT_THAT(with.inputs.robot, HasSubstr(base::yamlText(radius.dual_ukf.value).substr(0, 12)));
}

TEST_F(Experiments, ACancelBeforeTheFirstTrialKeepsNothing) {
  base::Progress progress;
  progress.cancel();
  const Results stopped = run(tracking(), {.out = folder_ / "none", .software = "test"}, progress);
  EXPECT_TRUE(stopped.cancelled);
  EXPECT_EQ(stopped.kept, 0);
}

TEST_F(Experiments, AFileThatIsNotThereIsNamedByTheSpecificationsLine) {
  const auto faultOf = [&](const std::string& text) {
    try {
      (void)runIn("bad", parseSpecification(text, folder_ / "bad.yaml"));
    } catch (const base::InputError& error) {
      return error.fault();
    }
    ADD_FAILURE() << "accepted:\n" << text;
    return base::InputFault{};
  };
  const std::string head = "name: bad\nwork: track\nimages: false\n";
  const auto check = [&](const std::string& text, int line, const std::string& key,
                         const std::string& value) {
    const base::InputFault fault = faultOf(head + text);
    EXPECT_EQ(fault.file, (folder_ / "bad.yaml").string()) << text;
    EXPECT_EQ(fault.line, line) << text;
    EXPECT_EQ(fault.key, key) << text;
    EXPECT_EQ(fault.value, value) << text;
    EXPECT_FALSE(fault.remedy.empty()) << text;
  };
  check("trials:\n  - {name: a, trajectory: hold}\n  - name: b\n    recording: none.capstan\n", 7,
        "trial b: recording", "none.capstan");
  check("truth: nowhere.yaml\ntrials:\n  - {name: a}\n", 4, "truth", "nowhere.yaml");
  check("nominal: nowhere.yaml\ntrials:\n  - {name: a}\n", 4, "nominal", "nowhere.yaml");
  check("robot: [nowhere.yaml]\ntrials:\n  - {name: a}\n", 4, "robot", "nowhere.yaml");
  check("robot: [Q]\ntrials:\n  - {name: a}\n", 4, "robot", "Q");
  check("tracking: nowhere.yaml\ntrials:\n  - {name: a}\n", 4, "tracking", "nowhere.yaml");
  check("trials:\n  - {name: a, trajectory: nowhere.yaml}\n", 5, "trial a: trajectory", "nowhere.yaml");
}

// The same motion again says nothing new: an identification, or the mean of trials, would be too sure of
// itself.
TEST_F(Experiments, ARecordingThatIsGivenTwiceIsRefused) {
  for (const char* name : {"a.csv", "copy.csv"}) base::writeTextFile(folder_ / name, "t,q_m1,q_m2,q_m3\n");
  base::writeTextFile(folder_ / "other.csv", "t,q_m1,q_m2,q_m4\n");  // as many bytes
  fs::create_symlink(folder_ / "a.csv", folder_ / "link.csv");
  const auto faultOf = [&](const std::string& work, const std::string& second) {
    const std::string text =
        "name: bad\nwork: " + work +
        "\ntrials:\n  - {name: one, recording: a.csv}\n  - {name: two, recording: " + second + "}\n";
    try {
      (void)runIn("bad", parseSpecification(text, folder_ / "bad.yaml"));
    } catch (const base::InputError& error) {
      return error.fault();
    }
    return base::InputFault{};
  };
  for (const char* work : {"identify", "track"})
    for (const char* second : {"a.csv", "copy.csv", "link.csv"}) {
      const base::InputFault fault = faultOf(work, second);
      EXPECT_EQ(fault.reason, "is the recording of trial one, too: it would count twice") << work << second;
      EXPECT_EQ(fault.key, "trial two: recording");
      EXPECT_EQ(fault.value, second);
      EXPECT_EQ(fault.line, 5);
      EXPECT_FALSE(fault.remedy.empty());
    }
  const auto accepted = ::testing::Not(HasSubstr("twice"));
  EXPECT_THAT(faultOf("track", "a.csv, occlusion: {percentage: 20}").reason, accepted);  // as experiment D
  EXPECT_THAT(faultOf("identify", "a.csv, occlusion: {percentage: 20}").reason, HasSubstr("twice"));
  EXPECT_THAT(faultOf("identify", "other.csv").reason, accepted);
}

TEST_F(Experiments, NumbersAndSeriesOfTwoRunsAreRefused) {
  std::string text = kTracking;
  text.replace(text.find("seed: 4"), 7, "seed: 6");
  (void)runIn("one", tracking());
  (void)runIn("two", parseSpecification(text, folder_ / "small.yaml"));
  fs::copy_file(folder_ / "one/small/series.json", folder_ / "two/small/series.json",
                fs::copy_options::overwrite_existing);
  try {
    (void)readResults(folder_ / "two" / "small");
    ADD_FAILURE() << "a mixture was read";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("series.json"));
    EXPECT_THAT(error.what(), HasSubstr("is of another run than results.json"));
    EXPECT_THAT(error.what(), HasSubstr("Run the experiment again"));
  }
}

TEST_F(Experiments, WhatCannotRunIsRefusedBeforehand) {
  const auto refuse = [&](const std::string& text) {
    EXPECT_THROW((void)runIn("bad", parseSpecification(text, folder_ / "bad.yaml")), base::InputError)
        << text;
    EXPECT_FALSE(fs::exists(folder_ / "bad")) << text;  // nothing was begun
  };
  const std::string head = "name: bad\nwork: track\nimages: false\n";
  refuse(head +
         "trials:\n  - {name: a, duration: 3, trajectory: sinusoid}\n  - {name: b, trajectory: waltz}\n");
  refuse(head + "robot: [A]\ntrials:\n  - {name: a, trajectory: waltz}\n");  // before A is run
  refuse(head + "truth: nowhere.yaml\ntrials:\n  - {name: a}\n");
  refuse(head + "robot: [Z]\ntrials:\n  - {name: a}\n");
  refuse(head + "robot: [C]\ntrials:\n  - {name: a}\n");  // identifies nothing
  refuse(head + "trials:\n  - {name: a, recording: none.capstan}\n");
  refuse("name: bad\nwork: identify\nidentification: {parameters: q_9}\ntrials:\n  - {name: a}\n");
}

TEST_F(Experiments, AFolderWithoutResultsIsRefused) {
  EXPECT_THROW((void)readResults(folder_), base::InputError);
  (void)runIn("one", tracking());
  const fs::path results = folder_ / "one" / "small" / "results.json";
  std::string text = base::readTextFile(results);
  const std::string version = "\"capstan_experiment_results\": 3";
  ASSERT_NE(text.find(version), std::string::npos);
  std::ofstream(results, std::ios::binary)
      << std::string(text).replace(text.find(version), version.size(), "\"capstan_experiment_results\": 1");
  try {
    (void)readResults(folder_ / "one" / "small");
    ADD_FAILURE() << "an older version was read";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("results.json"));
    EXPECT_THAT(error.what(), HasSubstr("is of another version of this program"));
    EXPECT_THAT(error.what(), HasSubstr("Run the experiment again into that folder"));
  }
  std::ofstream(results, std::ios::binary) << text;
  std::ofstream(folder_ / "one" / "small" / "series.json") << "{\"trials\": [";
  EXPECT_THROW((void)readResults(folder_ / "one" / "small"), base::InputError);
}

}  // namespace
}  // namespace capstan::experiments
