#include "core/recording/recover.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <map>

#include "core/base/error.h"
#include "core/recording/schema.h"
#include "core/recording/session_source.h"
#include "core/recording/session_writer.h"
#include "core/recording/sqlite.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using testing::TemporaryFolder;

constexpr int kRows = 4000;

/// A session of motor, joint and frame rows with an event; every 200th sample is a pair of images.
std::filesystem::path sessionIn(const TemporaryFolder& folder, bool ended = true) {
  const std::filesystem::path path = folder / "a.capstan";
  base::Random random(3);
  SessionWriter writer(path, testing::header(), SessionWriter::Durability::kPlain);
  writer.begin();
  for (std::int64_t seq = 1; seq <= kRows; ++seq) {
    const double t = 1e-3 * static_cast<double>(seq);
    if (seq % 200 == 0)
      writer.write(
          seq, tracking::StereoFrame{t, t + 0.03, testing::noisyImage(random), testing::noisyImage(random)});
    else if (seq % 2 == 0)
      writer.write(seq, tracking::JointSample{t, {1.0, 2.0, random.normal()}});
    else
      writer.write(seq,
                   tracking::MotorSample{t, {random.normal(), 2.0, 3.0}, {4.0, 5.0, 6.0}, {7.0, 8.0, 9.0}});
  }
  writer.write(kRows + 1, SessionEvent{4.0, "note", "the end"});
  writer.commit();
  if (ended) writer.finish();
  return path;
}

std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// All samples but images, as text with every bit.
std::map<double, std::string> samplesOf(const std::filesystem::path& path) {
  std::map<double, std::string> samples;
  SessionSource source(path);
  for (tracking::Sample sample; source.next(sample);) {
    std::string text;
    double t = 0.0;
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample))
      t = motor->t, text = fmt::format("m {}", motor->position.x());
    if (const auto* joint = std::get_if<tracking::JointSample>(&sample))
      t = joint->t, text = fmt::format("j {}", joint->position.z());
    if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample))
      t = frame->t, text = fmt::format("f {} {}", cv::sum(frame->left)[0], cv::sum(frame->right)[1]);
    samples[t] = text;
  }
  return samples;
}

const RecoveredRows& rowsOf(const Recovery& recovery, const std::string& table) {
  return *std::ranges::find(recovery.tables, table, &RecoveredRows::table);
}

TEST(Recover, AWholeSessionIsWholeAgain) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  const Recovery recovery = recoverSession(path, folder / "b.capstan");
  EXPECT_TRUE(recovery.whole()) << recovery.fault;
  EXPECT_EQ(recovery.saved(), kRows + 1);
  EXPECT_EQ(recovery.lost_rows, 0);
  EXPECT_TRUE(recovery.lost.empty() && recovery.lost_header.empty());
  for (const RecoveredRows& rows : recovery.tables) {
    EXPECT_EQ(rows.saved, rows.written) << rows.table;
    EXPECT_EQ(rows.damaged, 0) << rows.table;
  }
  EXPECT_EQ(samplesOf(folder / "b.capstan"), samplesOf(path));
  EXPECT_EQ(faultOf(folder / "b.capstan"), "");
}

TEST(Recover, AChangedNumberIsNoticedAndItsRowLeftOut) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  const auto before = samplesOf(path);
  std::string bytes = bytesOf(path);
  const double number = 4.0;  // velocity of motor 1, in every row of table motor
  std::string stored(8, '\0');
  for (int i = 0; i < 8; ++i)
    stored[static_cast<std::size_t>(i)] =
        static_cast<char>(std::bit_cast<std::uint64_t>(number) >> (56 - 8 * i));
  const std::size_t at = bytes.find(stored, bytes.size() / 2);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] ^= 0x10;
  write(path, bytes);

  EXPECT_THROW(samplesOf(path), base::InputError) << "never a wrong number without a word";
  const Recovery recovery = recoverSession(path, folder / "b.capstan");
  EXPECT_FALSE(recovery.whole());
  EXPECT_NE(recovery.fault.find("of table motor is not as it was written"), std::string::npos)
      << recovery.fault;
  EXPECT_EQ(rowsOf(recovery, "motor").damaged, 1);
  ASSERT_EQ(recovery.lost.size(), 1U);
  EXPECT_EQ(recovery.lost[0].count, 1);
  EXPECT_NEAR(recovery.lost[0].before - recovery.lost[0].after, 2e-3, 1e-9);
  const auto after = samplesOf(folder / "b.capstan");
  EXPECT_EQ(after.size() + 1, before.size());
  for (const auto& [t, text] : after) EXPECT_EQ(text, before.at(t)) << t;
}

TEST(Recover, OfATruncatedFileTheBeginningIsSaved) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  const auto before = samplesOf(path);
  const std::string bytes = bytesOf(path);
  write(path, bytes.substr(0, bytes.size() / 2 + 100));
  EXPECT_NE(faultOf(path), "");
  const Recovery recovery = recoverSession(path, folder / "b.capstan");
  EXPECT_FALSE(recovery.whole());
  EXPECT_GT(recovery.pages.missing, 0U);
  EXPECT_NEAR(static_cast<double>(recovery.pages.missing_bytes), static_cast<double>(bytes.size()) / 2.0,
              kPageSize);
  EXPECT_GT(rowsOf(recovery, "motor").saved, 100);
  for (const auto& [t, text] : samplesOf(folder / "b.capstan")) EXPECT_EQ(text, before.at(t)) << t;
}

TEST(Recover, WithoutAFirstPageEveryRowIsSaved) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  const auto before = samplesOf(path);
  std::string bytes = bytesOf(path);
  std::fill_n(bytes.begin(), kPageSize, '\x5a');
  write(path, bytes);
  const Recovery recovery = recoverSession(path, folder / "b.capstan");
  EXPECT_FALSE(recovery.whole());
  EXPECT_TRUE(recovery.complete());
  EXPECT_EQ(recovery.saved(), kRows + 1);
  EXPECT_EQ(samplesOf(folder / "b.capstan"), before);
  try {
    samplesOf(path);
    ADD_FAILURE() << "a file without a beginning was opened";
  } catch (const base::InputError& error) {
    EXPECT_TRUE(isRecoverable(error)) << error.what();
  }
}

/// A session with pages of `page_size`, whose first bytes are all `with`.
Recovery ofOverwritten(const TemporaryFolder& folder, int page_size, int bytes, char with) {
  const auto path = sessionIn(folder);
  Database(path, Database::Mode::kReadWrite).run(fmt::format("PRAGMA page_size = {}; VACUUM", page_size));
  std::string all = bytesOf(path);
  std::fill_n(all.begin(), bytes, with);
  write(path, all);
  return recoverSession(path, folder / "b.capstan");
}

TEST(Recover, WithoutTheFirstPageOfEitherSizeEveryRowIsSaved) {
  for (const int page_size : {kFormerPageSize, kPageSize})
    for (const char with : {'\x5a', '\0', '\n', '\r'}) {
      const TemporaryFolder folder;
      const Recovery recovery = ofOverwritten(folder, page_size, page_size, with);
      EXPECT_TRUE(recovery.complete()) << page_size << " " << int{with};
      EXPECT_EQ(recovery.saved(), kRows + 1);
    }
}

TEST(Recover, BehindAnOverwrittenBeginningOfEitherSizeTheRowsAreSaved) {
  constexpr int kBeginning = 65536;
  for (const int page_size : {kFormerPageSize, kPageSize}) {
    const TemporaryFolder folder;
    const Recovery recovery = ofOverwritten(folder, page_size, kBeginning, '\0');
    EXPECT_GT(recovery.saved(), kRows * 2 / 3) << page_size;
  }
}

TEST(Recover, PagesOfAnotherSizeAreRead) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  Database(path, Database::Mode::kReadWrite).run("PRAGMA page_size = 4096; VACUUM");
  const Recovery recovery = recoverSession(path, folder / "b.capstan");
  EXPECT_TRUE(recovery.whole()) << recovery.fault;
  EXPECT_EQ(recovery.saved(), kRows + 1);
}

/// SQLite would apply the log of a former recording to the new file.
TEST(Recover, ALogOfAFormerFileIsRemoved) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  {
    SessionWriter former(folder / "f.capstan", testing::header(), SessionWriter::Durability::kFast);
    former.begin();
    former.write(1, tracking::JointSample{1.0, {1.0, 2.0, 3.0}});
    former.commit();
    for (const char* suffix : {"", "-wal"})
      std::filesystem::copy_file((folder / "f.capstan").string() + suffix,
                                 (folder / "b.capstan").string() + suffix);
  }
  recoverSession(path, folder / "b.capstan");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.capstan-wal"));
  EXPECT_EQ(samplesOf(folder / "b.capstan"), samplesOf(path));
  EXPECT_THROW(recoverSession(path, folder / "a.capstan-wal"), base::InputError)
      << "it belongs to the damaged file";
}

TEST(Recover, LostEntriesOfTheHeaderAreStated) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  Database(path, Database::Mode::kReadWrite).run("UPDATE header SET value = 'x' WHERE key = 'truth'");
  const Recovery recovery = recoverSession(path, folder / "b.capstan");
  EXPECT_EQ(recovery.lost_header, std::vector<std::string>{"truth"});
  EXPECT_FALSE(recovery.complete());
}

TEST(Recover, ASessionOfANewerVersionIsRefused) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  Database(path, Database::Mode::kReadWrite).run("PRAGMA user_version = 3");
  EXPECT_THROW(recoverSession(path, folder / "b.capstan"), base::InputError);
}

TEST(Recover, ASessionThatDidNotEndIsWhole) {
  const TemporaryFolder folder;
  const Recovery recovery = recoverSession(sessionIn(folder, false), folder / "b.capstan");
  EXPECT_TRUE(recovery.whole()) << recovery.fault;
  EXPECT_EQ(recovery.saved(), kRows + 1);
  EXPECT_FALSE(rowsOf(recovery, "motor").written.has_value()) << "only a recording that ended knows";
}

TEST(Recover, RowsOfTheLogAreSavedToo) {
  const TemporaryFolder folder;
  const auto path = folder / "a.capstan", copy = folder / "copy.capstan";
  SessionWriter writer(path, testing::header(), SessionWriter::Durability::kFast);
  writer.begin();
  for (std::int64_t seq = 1; seq <= 500; ++seq)
    writer.write(seq, tracking::JointSample{1e-3 * static_cast<double>(seq), {1.0, 2.0, 3.0}});
  writer.commit();
  for (const char* suffix : {"", "-wal"})
    std::filesystem::copy_file(path.string() + suffix, copy.string() + suffix);
  const Recovery recovery = recoverSession(copy, folder / "b.capstan");
  EXPECT_EQ(rowsOf(recovery, "joint").saved, 500);
}

TEST(Recover, WithoutARobotOneIsAskedFor) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  Database(path, Database::Mode::kReadWrite).run("UPDATE header SET value = 'name: x' WHERE key = 'robot'");
  try {
    recoverSession(path, folder / "b.capstan");
    ADD_FAILURE() << "a robot that was changed was taken";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "robot");
    EXPECT_EQ(error.fault().remedy, "Give the robot file: --robot FILE");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "b.capstan"));
  const Recovery recovery = recoverSession(path, folder / "b.capstan", {base::writeYaml(testing::raven())});
  EXPECT_EQ(recovery.lost_header, std::vector<std::string>{"robot"});
  EXPECT_EQ(SessionSource(folder / "b.capstan").info().robot.name, testing::raven().name);
}

TEST(Recover, OfAnotherFileNothingIsSaved) {
  const TemporaryFolder folder;
  write(folder / "a.capstan", std::string(100'000, 'x'));
  EXPECT_EQ(recoverSession(folder / "a.capstan", folder / "b.capstan").saved(), 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.capstan"));
  EXPECT_THROW(recoverSession(folder / "none.capstan", folder / "b.capstan"), base::InputError);
}

/// Files of Capstan 0.2 have neither check sums nor the numbers of rows, and the former page size.
void makeFormer(const std::filesystem::path& path) {
  Database database(path, Database::Mode::kReadWrite);
  for (const Table& table : tables()) database.run(fmt::format("ALTER TABLE {} DROP COLUMN crc", table.name));
  database.run("DELETE FROM header WHERE key = 'rows'; PRAGMA user_version = 1");
  database.run(fmt::format("PRAGMA page_size = {}; VACUUM", kFormerPageSize));
}

TEST(Recover, WithoutAFirstPageRowsOfTheFormerVersionAreSaved) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  const auto before = samplesOf(path);
  makeFormer(path);
  std::string bytes = bytesOf(path);
  std::fill_n(bytes.begin(), kFormerPageSize, '\0');
  write(path, bytes);
  EXPECT_EQ(recoverSession(path, folder / "b.capstan").saved(), kRows + 1);
  EXPECT_EQ(samplesOf(folder / "b.capstan"), before);
}

TEST(Recover, SessionsOfTheFormerVersionAreReadAndRecovered) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  const auto before = samplesOf(path);
  makeFormer(path);
  EXPECT_EQ(samplesOf(path), before);
  const Recovery whole = recoverSession(path, folder / "b.capstan");
  EXPECT_TRUE(whole.whole()) << whole.fault;
  EXPECT_FALSE(whole.checked);
  EXPECT_EQ(whole.saved(), kRows + 1);
  EXPECT_EQ(samplesOf(folder / "b.capstan"), before);

  const std::string bytes = bytesOf(path);
  write(path, bytes.substr(0, bytes.size() / 2));
  EXPECT_FALSE(recoverSession(path, folder / "c.capstan").whole());
  for (const auto& [t, text] : samplesOf(folder / "c.capstan")) EXPECT_EQ(text, before.at(t)) << t;
}

TEST(Recover, VanishedRowsAreNoticed) {
  const TemporaryFolder folder;
  const auto path = sessionIn(folder);
  Database(path, Database::Mode::kReadWrite).run("DELETE FROM joint WHERE seq = 2002");
  EXPECT_THROW(SessionSource{path}, base::InputError);
  const Recovery recovery = recoverSession(path, folder / "b.capstan");
  EXPECT_NE(recovery.fault, "");
  EXPECT_EQ(rowsOf(recovery, "joint").saved + 1, rowsOf(recovery, "joint").written);
  EXPECT_EQ(recovery.lost_rows, 1);
  EXPECT_FALSE(recovery.complete());
}

}  // namespace
}  // namespace capstan::recording
