// The file as others see it: plain SQLite with a dictionary; and files that are none.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "core/recording/recorder.h"
#include "core/recording/schema.h"
#include "core/recording/session_source.h"
#include "core/recording/sqlite.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using namespace testing;

class SessionFile : public ::testing::Test {
 protected:
  std::filesystem::path record(const std::string& name = "a.capstan") {
    RecorderOptions options;
    options.width = 64;
    options.height = 48;
    options.frame_rate = 200.0;
    Recorder recorder(folder_ / name, header(), options);
    for (const auto& sample : someSamples(1, 400)) recorder.offer(sample);
    return folder_ / name;
  }

  static base::InputFault faultOf(const std::filesystem::path& path) {
    try {
      SessionSource source(path);
      for (tracking::Sample sample; source.next(sample);) {
      }
    } catch (const base::InputError& error) {
      return error.fault();
    }
    ADD_FAILURE() << path << " was accepted";
    return {};
  }

  TemporaryFolder folder_;
};

TEST_F(SessionFile, TheDictionaryExplainsEveryColumnOfEveryTable) {
  Database database(record(), Database::Mode::kRead);
  Statement tables(database, "SELECT name FROM sqlite_master WHERE type = 'table'");
  int seen = 0;
  while (tables.step()) {
    const std::string table = tables.text(0);
    Statement columns(database, "SELECT name, type FROM pragma_table_info('" + table + "')");
    while (columns.step()) {
      Statement entry(database,
                      "SELECT unit, meaning FROM dictionary WHERE table_name = ? AND column_name = ?");
      entry.bind(1, std::string_view(table));
      entry.bind(2, columns.text(0));
      ASSERT_TRUE(entry.step()) << table << "." << columns.text(0);
      EXPECT_FALSE(entry.text(1).empty()) << table << "." << columns.text(0);
      if (columns.text(1).empty()) {
        EXPECT_FALSE(entry.text(0).empty()) << table << "." << columns.text(0) << " has no unit";
      }
      ++seen;
    }
  }
  EXPECT_EQ(seen, database.number("SELECT count(*) FROM dictionary WHERE column_name <> ''"));
}

TEST_F(SessionFile, IsOnePlainFileOnceClosed) {
  const auto path = record();
  EXPECT_FALSE(std::filesystem::exists(path.string() + "-wal"));
  EXPECT_FALSE(std::filesystem::exists(path.string() + "-shm"));
  Database database(path, Database::Mode::kRead);
  EXPECT_EQ(database.number("PRAGMA application_id"), kApplicationId);
  EXPECT_EQ(database.number("PRAGMA user_version"), kSchemaVersion);
  Statement check(database, "PRAGMA integrity_check");
  ASSERT_TRUE(check.step());
  EXPECT_EQ(check.text(0), "ok");
}

TEST_F(SessionFile, NumbersAreNumbersToEveryTool) {
  Database database(record(), Database::Mode::kRead);
  EXPECT_EQ(database.number("SELECT count(*) FROM motor WHERE typeof(t) <> 'real'"), 0);
  EXPECT_EQ(database.number("SELECT count(*) FROM motor WHERE typeof(q_m1) NOT IN ('real', 'null')"), 0);
  EXPECT_GT(database.number("SELECT count(*) FROM motor WHERE typeof(q_m1) = 'real'"), 0);
}

TEST_F(SessionFile, CountsAgreeWithWhatWasOffered) {
  const SessionSummary summary = readSessionSummary(record());
  std::int64_t kinds[4] = {};
  for (const auto& sample : someSamples(1, 400)) ++kinds[sample.index()];
  EXPECT_EQ(summary.motor, kinds[0]);
  EXPECT_EQ(summary.frames, kinds[1]);
  EXPECT_EQ(summary.tip, kinds[2]);
  EXPECT_EQ(summary.joint, kinds[3]);
  EXPECT_EQ(summary.width, 64);
  EXPECT_EQ(summary.height, 48);
  EXPECT_EQ(summary.header.software, "capstan test");
}

TEST_F(SessionFile, AnExistingFileIsNotOverwritten) {
  const auto path = record();
  EXPECT_THROW(Recorder(path, header()), base::InputError);
  EXPECT_THROW(Recorder(folder_ / "no/such/folder/a.capstan", header()), base::InputError);
  EXPECT_GT(readSessionSummary(path).motor, 0);
}

TEST_F(SessionFile, MissingEmptyTextAndFolder) {
  EXPECT_FALSE(faultOf(folder_ / "missing.capstan").remedy.empty());
  EXPECT_EQ(faultOf(folder_.path()).reason, "is not a file");
  std::ofstream(folder_ / "empty.capstan").flush();
  EXPECT_NE(faultOf(folder_ / "empty.capstan").reason.find("not a session"), std::string::npos);
  std::ofstream(folder_ / "text.capstan") << "t,q_m1\n0,1\n";
  EXPECT_NE(faultOf(folder_ / "text.capstan").reason.find("not a session"), std::string::npos);
}

TEST_F(SessionFile, AnotherProgramsDatabase) {
  Database(folder_ / "b.sqlite", Database::Mode::kCreate).run("CREATE TABLE motor (t)");
  EXPECT_NE(faultOf(folder_ / "b.sqlite").reason.find("another program"), std::string::npos);
}

TEST_F(SessionFile, ANewerVersionAsksForANewerProgram) {
  const auto path = record();
  Database(path, Database::Mode::kReadWrite).run("PRAGMA user_version = 99");
  const auto fault = faultOf(path);
  EXPECT_NE(fault.reason.find("99"), std::string::npos);
  EXPECT_NE(fault.remedy.find("newer"), std::string::npos);
}

TEST_F(SessionFile, AMissingTable) {
  const auto path = record();
  Database(path, Database::Mode::kReadWrite).run("DROP TABLE event");
  EXPECT_NE(faultOf(path).reason.find("event"), std::string::npos);
}

TEST_F(SessionFile, CutAnywhereItSaysSo) {
  const auto whole = record();
  const auto size = std::filesystem::file_size(whole);
  for (const double share : {0.0005, 0.1, 0.5, 0.9, 0.99}) {
    const auto cut = folder_ / "cut.capstan";
    std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, static_cast<std::uintmax_t>(static_cast<double>(size) * share));
    const auto fault = faultOf(cut);
    EXPECT_EQ(fault.file, cut.string()) << share;
    EXPECT_FALSE(fault.remedy.empty()) << share;
  }
}

TEST_F(SessionFile, OverwrittenPagesAreFoundWhereTheyAreRead) {
  const auto path = record();
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path));
    const std::string noise(static_cast<std::size_t>(size / 2), '\xa5');
    file.seekp(size / 3);
    file.write(noise.data(), static_cast<std::streamsize>(noise.size()));
  }
  EXPECT_NE(faultOf(path).reason.find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace capstan::recording
