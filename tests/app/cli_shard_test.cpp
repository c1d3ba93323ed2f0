// --shard and merge: the results are those of one process for every sharding, and nothing else is merged.
#include <gmock/gmock.h>

#include <map>
#include <vector>

#include "core/experiments/shard_record.h"
#include "core/math/instruction_set.h"
#include "tests/app/cli_fixture.h"

namespace capstan::testing {
namespace {

using experiments::readRecord;
using experiments::ShardRecord;
using experiments::writeRecord;
using ::testing::HasSubstr;

class CliShard : public Cli {
 protected:
  /// Files of a folder of results by name, without stored trials and without times, which differ from run to
  /// run.
  std::map<std::string, std::string> resultsIn(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      const std::string name = fs::relative(entry.path(), folder_ / folder).string();
      const bool outside = name.find("trials/") != std::string::npos || name.ends_with("timing.json") ||
                           name.starts_with("merge.json") || name.starts_with("cost.");
      if (entry.is_regular_file() && !outside) files[name] = textOf(folder + "/" + name);
    }
    return files;
  }
  /// Runs all shards of `command`. Returns their folders, the last one first.
  std::vector<std::string> shards(const std::string& command, int count, const std::string& name) const {
    std::vector<std::string> folders;
    for (int i = 1; i <= count; ++i) {
      const std::string part = std::to_string(i) + "/" + std::to_string(count);
      folders.insert(folders.begin(), path(name + std::to_string(i)));
      const Ran ran = run(command + " --shard " + part + " --out " + folders.front());
      EXPECT_EQ(ran.exit, 0) << command << " " << part << ran.err;
      EXPECT_THAT(ran.out, HasSubstr("shard " + part + ": "));
    }
    return folders;
  }
  Ran merge(const std::string& out, const std::vector<std::string>& folders,
            const std::string& before = {}) const {
    std::string words = "merge " + path(out);
    for (const std::string& folder : folders) words += " " + folder;
    return run(words, before);
  }
  void expectTheSameForEverySharding(const std::string& command, const std::vector<int>& counts) const {
    ASSERT_EQ(run(command + " --out " + path("whole")).exit, 0);
    const auto whole = resultsIn("whole");
    EXPECT_GE(whole.size(), 2U);
    for (const int count : counts) {
      const std::string name = "n" + std::to_string(count);
      const Ran merged = merge(name, shards(command, count, name + "-"));
      ASSERT_EQ(merged.exit, 0) << merged.err;
      EXPECT_THAT(merged.out, HasSubstr("Computing time of the trials"));
      const auto files = resultsIn(name);
      EXPECT_EQ(files.size(), whole.size());
      for (const auto& [file, text] : whole)
        EXPECT_TRUE(files.contains(file) && files.at(file) == text) << file;
    }
  }
  void expectRefused(const std::vector<std::string>& folders, const std::string& text,
                     const std::string& remedy, const std::string& before = {}) const {
    const Ran ran = merge("refused", folders, before);
    EXPECT_EQ(ran.exit, 2) << text << ran.out;
    EXPECT_THAT(ran.err, HasSubstr(text));
    EXPECT_THAT(ran.err, HasSubstr(remedy));
    EXPECT_FALSE(fs::exists(path("refused"))) << text;
  }
  /// An experiment of `trials` short trials with their numbers as seeds.
  std::string specification(const std::string& name, int trials, double duration = 1.5) const {
    std::string text = "name: " + name + "\nwork: track\nimages: false\ntrials:\n";
    for (int i = 1; i <= trials; ++i)
      text += "  - {name: t" + std::to_string(i) +
              ", trajectory: sinusoid, duration: " + std::to_string(duration) +
              ", seed: " + std::to_string(i) + "}\n";
    write(name + ".yaml", text);
    return path(name + ".yaml");
  }
};

TEST_F(CliShard, AnExperimentIsThatOfOneProcess) {
  expectTheSameForEverySharding("experiment " + specification("small", 5), {1, 2, 3, 7});
}

constexpr const char* kIdentifies =
    "name: radius\nwork: identify\nimages: false\nidentification: {parameters: r_l}\ntrials:\n"
    "  - {name: swing, trajectory: sinusoid, duration: 12}\n";

TEST_F(CliShard, AnExperimentWithAnIdentifiedRobotIsThatOfOneProcess) {
  write("radius.yaml", kIdentifies);
  write("user.yaml",
        "name: user\nwork: track\nimages: false\nrobot: [radius]\ntrials:\n"
        "  - {name: a, trajectory: sinusoid, duration: 2, seed: 2}\n"
        "  - {name: b, trajectory: sinusoid, duration: 2, seed: 3}\n");
  expectTheSameForEverySharding("experiment " + path("user.yaml"), {2, 3});
  EXPECT_TRUE(fs::exists(folder_ / "n3-2/radius"));
  EXPECT_FALSE(fs::exists(folder_ / "n3-3/radius")) << "a shard without trials identifies nothing";
}

TEST_F(CliShard, AnIdentificationIsOneTrial) {
  write("radius.yaml", kIdentifies);
  expectTheSameForEverySharding("experiment " + path("radius.yaml"), {2});
  EXPECT_THAT(textOf("n2-2/shard.json"), HasSubstr("\"own\": []"));
}

TEST_F(CliShard, AStudyIsThatOfOneProcess) {
  expectTheSameForEverySharding("study filter --no-images --duration 2 --settled 1 --seeds 3 --occlude 0 40",
                                {1, 2, 3, 7});
}

TEST_F(CliShard, EveryStudyWithIndependentTrialsIsThatOfOneProcess) {
  for (const char* command :
       {"study one-camera --duration 2 --occlude 20 80", "study health --sessions 2 --duration 5",
        "study motor-failure --duration 5 --seeds 2 --speeds 2 --occlusions 0"}) {
    for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry);
    expectTheSameForEverySharding(command, {2});
  }
}

TEST_F(CliShard, TheSeedOfATrialDependsOnItsPlaceOnly) {
  const std::string command = "study filter --no-images --duration 2 --settled 1 --json - --seeds ";
  const json few = json::parse(run(command + "2").out)["comparisons"];
  const json many = json::parse(run(command + "4").out)["comparisons"];
  ASSERT_EQ(few.size(), 4U);
  ASSERT_EQ(many.size(), 8U);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], many[i]);
}

TEST_F(CliShard, MergeHasTheJsonOfTheCommandAndTheCostOfATrial) {
  const std::string command = "experiment " + specification("small", 3);
  const json whole = json::parse(run(command + " --json - --out " + path("whole")).out);
  std::string words = "merge --json - " + path("merged");
  for (const std::string& folder : shards(command, 2, "s")) words += " " + folder;
  const Ran merged = run(words);
  ASSERT_EQ(merged.exit, 0) << merged.err;
  EXPECT_EQ(json::parse(merged.out), whole);
  const json cost = json::parse(textOf("merged/cost.json"));
  EXPECT_EQ(cost["trials"], 3);
  EXPECT_GT(cost["median"], 0.0);
  EXPECT_LE(cost["median"], cost["quantile_95"]);
  EXPECT_EQ(run(words).exit, 0) << "merged again into the same folder";
}

TEST_F(CliShard, AnInterruptedShardGoesOn) {
  const std::string command = "experiment " + specification("small", 12, 4.0);
  ASSERT_EQ(run(command + " --out " + path("whole")).exit, 0);
  const std::string first = command + " --threads 1 --shard 1/2 --out " + path("s1");
  const std::string stored = path("s1/small/trials/t1.json");
  const Ran killed = interrupt(first, stored, SIGKILL);
  EXPECT_EQ(killed.exit, -1);
  ASSERT_EQ(run(command + " --shard 2/2 --out " + path("s2")).exit, 0);
  expectRefused({path("s1"), path("s2")}, "s1/shard.json: shard 1/2 is not finished",
                "--shard 1/2 --out " + path("s1"));
  const auto written = fs::last_write_time(stored);
  const Ran stopped = interrupt(first, path("s1/small/trials/t3.json"), SIGTERM);
  EXPECT_EQ(stopped.exit, 1);
  EXPECT_THAT(stopped.err, HasSubstr("the same command goes on"));
  ASSERT_EQ(run(first).exit, 0);
  EXPECT_EQ(fs::last_write_time(stored), written) << "run again";
  ASSERT_EQ(merge("merged", {path("s1"), path("s2")}).exit, 0);
  EXPECT_EQ(resultsIn("merged"), resultsIn("whole"));
}

TEST_F(CliShard, OtherShardsAreRefused) {
  const std::string command = "experiment " + specification("small", 3);
  const std::vector<std::string> all = shards(command, 3, "s");
  const std::string s1 = path("s1"), s2 = path("s2"), s3 = path("s3");
  expectRefused({s1, s3}, "1 of 3 shards is missing: 2", command + " --shard 2/3");
  expectRefused({s1, s2, s3, s2}, "is shard 2/3, and so is", "Give each shard once");
  fs::copy(s2, path("copy"), fs::copy_options::recursive);
  expectRefused({s1, s2, s3, path("copy")}, "is shard 2/3, and so is", "Give each shard once");
  expectRefused({s1, s2, path("none")}, "none: is no folder of a shard", "--shard");
  shards(command, 2, "two");
  expectRefused({s1, s2, path("two1")}, "two1/shard.json: is one of 2 shards", "Merge the shards of one");
  shards("experiment " + specification("other", 3), 3, "o");
  expectRefused({s1, s2, path("o3")}, "o3/shard.json: is of `experiment", "Merge the shards of one command");
  shards(command + " --images", 3, "i");
  expectRefused({path("i1"), s2, s3}, "s2/shard.json: is of `experiment", "Merge the shards of one command");

  ShardRecord record = readRecord(s2);
  record.software = "capstan 0.0";
  writeRecord(record, s2);
  expectRefused({s1, s2, s3}, "s2/shard.json: was computed by capstan 0.0, and", "one version");
  for (const std::string& folder : {s1, s3}) {
    ShardRecord older = readRecord(folder);
    older.software = "capstan 0.0";
    writeRecord(older, folder);
  }
  expectRefused({s1, s2, s3}, "was computed by capstan 0.0, and this is", "compute them again");
}

TEST_F(CliShard, MissingDamagedAndForeignTrialsAreRefused) {
  const std::string file = specification("small", 3), command = "experiment " + file;
  const std::vector<std::string> all = shards(command, 2, "s");
  const std::string again = "Run: capstan-cli " + command + " --shard 1/2 --out " + path("s1");
  const std::string trial = path("s1/small/trials/t3.json"), text = textOf("s1/small/trials/t3.json");
  std::string changed = text;
  const std::size_t digit = changed.find("\"rms\":[[") + 12;
  changed[digit] = changed[digit] == '1' ? '2' : '1';
  write("s1/small/trials/t3.json", changed);
  expectRefused(all, "t3.json: is damaged (wrong checksum)", again);
  fs::remove(trial);
  expectRefused(all, "t3.json: does not exist: a trial of shard 1/2", again);
  fs::copy_file(path("s1/small/trials/t1.json"), trial);
  expectRefused(all, "t3.json: was made from something else (name, seed", "unchanged input files");
  fs::remove(trial);
  ASSERT_EQ(run(command + " --shard 1/2 --out " + path("s1")).exit, 0);
  ASSERT_EQ(merge("merged", all).exit, 0) << "healed by the command that the refusal gives";

  ShardRecord record = readRecord(path("s1"));
  record.lists.front().own.pop_back();
  writeRecord(record, path("s1"));
  expectRefused(all, "lists 1 of its 2 trials", again);
  ASSERT_EQ(run(command + " --shard 1/2 --out " + path("s1")).exit, 0);

  const std::string specified = textOf("small.yaml");
  std::string other = specified;
  other.replace(other.find("seed: 2"), 7, "seed: 9");
  write("small.yaml", other);
  expectRefused(all, "t2.json: was made from something else (seed", "unchanged input files");
  std::string renamed = specified;
  renamed.replace(renamed.find("name: t2"), 8, "name: tt");
  write("small.yaml", renamed);
  ASSERT_EQ(run(command + " --shard 2/2 --out " + path("s2")).exit, 0);
  expectRefused(all, "s2/shard.json: lists other trials than", "same input files");
}

TEST_F(CliShard, ShardsOfProcessorsOfTwoKindsAreRefused) {
  if (math::bestInstructionSet() == math::InstructionSet::kBaseline) GTEST_SKIP() << "this processor has one";
  const std::string baseline = "CAPSTAN_INSTRUCTION_SET=baseline ";
  const std::string command = "experiment " + specification("small", 2);
  const std::vector<std::string> all = shards(command, 2, "s");
  ASSERT_EQ(run(command + " --shard 2/2 --out " + path("b2"), baseline).exit, 0);
  expectRefused({path("s1"), path("b2")}, "b2/shard.json: was computed with baseline instructions",
                "CAPSTAN_INSTRUCTION_SET=baseline");
  ASSERT_EQ(run(command + " --shard 1/2 --out " + path("b1"), baseline).exit, 0);
  ASSERT_EQ(run(command + " --out " + path("whole"), baseline).exit, 0);
  ASSERT_EQ(merge("merged", {path("b1"), path("b2")}).exit, 0) << "merging computes nothing";
  EXPECT_EQ(resultsIn("merged"), resultsIn("whole"));
  EXPECT_EQ(run("experiment A --out " + path("x"), "CAPSTAN_INSTRUCTION_SET=best ").exit, 2);
}

TEST_F(CliShard, FoldersAndOptionsThatDoNotFitAreRefused) {
  const std::string command = "experiment " + specification("small", 2);
  const std::vector<std::string> all = shards(command, 2, "s");
  const auto refused = [&](const std::string& words, const std::string& text) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit, 2) << words;
    EXPECT_THAT(ran.err, HasSubstr(text)) << words;
  };
  refused(command + " --shard 1/2 --out " + path("s2"), "s2/shard.json: is of shard 2/2");
  refused(command + " --no-images --shard 2/2 --out " + path("s2"), "s2/shard.json: is of shard 2/2");
  refused(command + " --shard 3/2 --out " + path("x"), "--shard = 3/2: is no part of a whole");
  refused(command + " --shard 1/2", "needs a folder of its own");
  refused("study filter --shard 1/2", "needs a folder of its own");
  refused(command + " --shard 1/2 --json - --out " + path("x"), "Give it to `capstan-cli merge`");
  refused("study motor-failure --csv a.csv --shard 1/2 --out " + path("x"), "Give it to `capstan-cli merge`");
  refused("experiment E poses.csv --shard 1/2 --out " + path("x"), "one computation over all of its data");
  refused("study cramer-rao --shard 1/2 --out " + path("x"), "averages all runs at every time step");
  refused("diagnose x.csv --shard 1/2", "explains all recordings by one model");
  EXPECT_FALSE(fs::exists(path("x")));
  EXPECT_FALSE(fs::exists("capstan-experiments"));

  refused("merge " + path("s1") + " " + path("s1") + " " + path("s2"), "s1: is the folder of a shard");
  fs::create_directories(path("full"));
  write("full/notes.txt", "mine");
  refused("merge " + path("full") + " " + path("s1") + " " + path("s2"), "full: holds other files");
  EXPECT_EQ(textOf("full/notes.txt"), "mine");
}

}  // namespace
}  // namespace capstan::testing
