// Shards of a list of trials: every trial in one of them; their text; records; the cost of a trial.
#include "core/experiments/shard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/shard_record.h"
#include "core/experiments/trial_cost.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Shard, EveryTrialBelongsToOneShardAndShardsDifferByOneTrial) {
  for (const std::size_t count : {1U, 2U, 3U, 7U, 100U})
    for (const std::size_t trials : {0U, 1U, 5U, 20U}) {
      std::vector<int> owners(trials, 0);
      std::size_t least = trials, most = 0;
      for (std::size_t index = 1; index <= count; ++index) {
        const Shard shard{index, count};
        std::size_t own = 0;
        for (std::size_t k = 0; k < trials; ++k)
          if (shard.owns(k)) {
            ++owners[k];
            ++own;
          }
        least = std::min(least, own);
        most = std::max(most, own);
      }
      EXPECT_THAT(owners, ::testing::Each(1));
      EXPECT_LE(most, least + 1);
    }
}

TEST(Shard, IsReadFromItsText) {
  EXPECT_EQ(parseShard("1/1"), (Shard{1, 1}));
  EXPECT_EQ(parseShard("3/70"), (Shard{3, 70}));
  EXPECT_EQ(nameOf(parseShard("1000000/1000000")), "1000000/1000000");
  for (const char* wrong : {"", "1", "/", "1/", "/2", "0/2", "3/2", "-1/2", "1/2/3", "1/2 ", " 1/2", "a/b",
                            "1.0/2", "1/1000001", "1/99999999999999999999999"})
    try {
      (void)parseShard(wrong);
      ADD_FAILURE() << wrong;
    } catch (const base::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("for example 2/8")) << wrong;
    }
}

TEST(Shard, ListsContinueWhereTheListBeforeEnded) {
  PartialRun part{.shard = {2, 3}, .out = "results"};
  part.add("results/a/trials", {"a0", "a1"});
  EXPECT_TRUE(part.includes(2)) << "trial 2 of the next list is trial 4 of the command";
  EXPECT_FALSE(part.includes(0));
  part.addShared("results/b/trials", "identification");
  part.add("results/c/trials", {"c0", "c1", "c2"});
  ASSERT_EQ(part.lists.size(), 3U);
  EXPECT_THAT(part.lists[0].own, ElementsAre("a1"));
  EXPECT_TRUE(part.lists[1].shared);
  EXPECT_THAT(part.lists[2].own, ElementsAre("c2"));
  EXPECT_EQ(part.lists[2].folder, "c/trials");
  EXPECT_EQ(part.trials, 5U);
}

class ShardFolder : public ::testing::Test {
 protected:
  ShardFolder() : folder_(fs::temp_directory_path() / ("capstan_shard_" + std::to_string(getpid()))) {}
  ~ShardFolder() override { fs::remove_all(folder_); }

  fs::path folder_;
  ShardRecord record_{.command = {"study", "latency", "--delays", "0 .1", "it's"},
                      .software = "capstan 1",
                      .processor = "baseline",
                      .shard = {2, 3},
                      .finished = true,
                      .lists = {{"trials", 4, "0123456789abcdef", {"b"}, false}}};
};

TEST_F(ShardFolder, KeepsItsRecord) {
  writeRecord(record_, folder_);
  const ShardRecord read = readRecord(folder_);
  EXPECT_EQ(read.command, record_.command);
  EXPECT_EQ(read.software, record_.software);
  EXPECT_EQ(read.processor, record_.processor);
  EXPECT_EQ(read.shard, record_.shard);
  EXPECT_TRUE(read.finished);
  EXPECT_EQ(read.lists.front().own, record_.lists.front().own);
  EXPECT_EQ(read.trials(), 4U);
  EXPECT_EQ(read.own(), 1U);
  EXPECT_EQ(commandLineOf(read, {3, 3}, "a b"),
            "capstan-cli study latency --delays '0 .1' 'it'\\''s' --shard 3/3 --out 'a b'");
}

TEST_F(ShardFolder, OfAnotherShardOrCommandIsRefused) {
  writeRecord(record_, folder_);
  EXPECT_NO_THROW(checkRecord(record_, folder_));
  EXPECT_NO_THROW(checkRecord(record_, folder_ / "new"));
  ShardRecord other = record_;
  other.shard.index = 1;
  EXPECT_THROW(checkRecord(other, folder_), base::InputError);
  other = record_;
  other.command.pop_back();
  EXPECT_THROW(checkRecord(other, folder_), base::InputError);
}

TEST_F(ShardFolder, WithADamagedRecordIsRefused) {
  writeRecord(record_, folder_);
  const std::string text = base::readTextFile(recordFile(folder_));
  std::string changed = text;
  changed.replace(changed.find("\"of\": 3"), 7, "\"of\": 4");
  for (const std::string& damaged :
       {changed, text.substr(0, text.size() / 2), std::string(), std::string("{}")}) {
    std::ofstream(recordFile(folder_), std::ios::binary) << damaged;
    try {
      (void)readRecord(folder_);
      ADD_FAILURE() << damaged;
    } catch (const base::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("shard.json"));
      EXPECT_THAT(error.what(), HasSubstr("Run the command of this shard again"));
    }
  }
}

/// numpy.quantile([1, 2, 3, 4, 5], 0.95) is 4.8; 10⁶ · 3 s / 64 is 46 875 s = 13.0 h.
TEST(TrialCost, IsThatOfTheMeasuredTimes) {
  const TrialCost cost = costOf({5.0, 1.0, std::numeric_limits<double>::quiet_NaN(), 3.0, 2.0, 4.0});
  EXPECT_EQ(cost.trials, 5U);
  EXPECT_DOUBLE_EQ(cost.median, 3.0);
  EXPECT_DOUBLE_EQ(cost.high, 4.8);
  EXPECT_DOUBLE_EQ(cost.mean, 3.0);
  EXPECT_DOUBLE_EQ(cost.total, 15.0);
  EXPECT_DOUBLE_EQ(cost.predicted(1e6, 64.0), 46875.0);
  const base::Table table = costTable(cost);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0][4].text, "34.7 days");
  EXPECT_EQ(table.rows[0][6].text, "13.0 h");
  EXPECT_EQ(table.rows[0][8].text, "2930 s");
  EXPECT_EQ(costTable(costOf({})).rows[0][6].text, "–");
}

}  // namespace
}  // namespace capstan::experiments
