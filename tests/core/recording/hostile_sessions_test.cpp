// Sessions of strangers: with SQL of their own, impossible numbers under valid check sums, and pages that are
// shared.
#include <gmock/gmock.h>
#include <sqlite3.h>

#include <fstream>

#include "core/base/error.h"
#include "core/recording/recover.h"
#include "core/recording/row_check.h"
#include "core/recording/row_counts.h"
#include "core/recording/session_images.h"
#include "core/recording/session_source.h"
#include "core/recording/session_writer.h"
#include "core/recording/sqlite.h"
#include "core/recording/sqlite_pages.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

class HostileSession : public ::testing::Test {
 protected:
  HostileSession() {
    base::Random random(3);
    SessionWriter writer(path_, testing::header(), SessionWriter::Durability::kPlain);
    writer.begin();
    for (std::int64_t seq = 1; seq <= 20; ++seq)
      writer.write(seq,
                   tracking::MotorSample{1e-3 * static_cast<double>(seq), {1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
    writer.write(21,
                 tracking::StereoFrame{0.03, 0.04, testing::noisyImage(random), testing::noisyImage(random)});
    writer.commit();
    writer.finish();
    run("DELETE FROM header WHERE key = 'rows'");
  }

  /// Runs SQL with our check sums: a stranger can compute them.
  void run(const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    addRowCheck(database);
    char* fault = nullptr;
    sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &fault);
    EXPECT_EQ(fault, nullptr) << fault;
    sqlite3_free(fault);
    sqlite3_close(database);
  }
  /// Changes rows, then makes their check sums true.
  void change(const std::string& table, const std::string& names, const std::string& sql) {
    run(sql + "; UPDATE " + table + " SET crc = row_crc('" + table + "', " + names + ")");
  }
  std::string errorOfReading() const {
    try {
      SessionSource source(path_);
      tracking::Sample sample;
      while (source.next(sample)) {
      }
      SessionImages images(path_);
      tracking::StereoFrame frame;
      images.at(0.03, 1.0, frame);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }
  /// Version 1, in which rows have no check sums.
  void makeOld() {
    for (const Table& table : tables()) run("ALTER TABLE " + std::string(table.name) + " DROP COLUMN crc");
    run("PRAGMA user_version = 1");
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "trial.capstan";
};

constexpr const char* kFrame = "seq, t, t_arrival, codec, width, height, \"left\", \"right\"";
constexpr const char* kCodec = "id, name, width, height, fourcc, extradata";

TEST_F(HostileSession, IsReadAsItWasWritten) { EXPECT_EQ(errorOfReading(), ""); }

TEST_F(HostileSession, ItsSqlCallsNoneOfOurFunctions) {  // row_crc() without arguments read beyond them
  run("DROP TABLE event; CREATE VIEW event AS SELECT row_crc() AS seq, row_holds() AS t");
  EXPECT_THAT(errorOfReading(), HasSubstr("lacks the table event"));
  Database database(path_, Database::Mode::kRead);
  EXPECT_THROW(database.run("SELECT row_crc()"), SqliteError);
  EXPECT_THROW(database.run("SELECT row_holds(1, 'motor')"), SqliteError);
}

TEST_F(HostileSession, ComputedColumnsAndVirtualTablesAreNoTablesOfASession) {
  run("ALTER TABLE event ADD COLUMN more AS (hex(zeroblob(100000000)))");
  EXPECT_THAT(errorOfReading(), HasSubstr("has columns that are computed in the table event"));
  run("DROP TABLE event; CREATE VIRTUAL TABLE event USING fts5(seq, t)");
  EXPECT_THAT(errorOfReading(), HasSubstr("lacks the table event"));
}

TEST_F(HostileSession, ChoosesNoCodecAndNoImpossibleSize) {
  change("codec", kCodec, "UPDATE codec SET name = 'mjpeg'");
  EXPECT_THAT(errorOfReading(), HasSubstr("codec = mjpeg: is not a codec of sessions"));
  change("codec", kCodec, "UPDATE codec SET name = 'utvideo', width = 16384, height = 16384");
  EXPECT_THAT(errorOfReading(), HasSubstr("impossible size of images"));
  change("codec", kCodec, "UPDATE codec SET width = 4294967360");  // 64 in 32 bits
  EXPECT_THAT(errorOfReading(), HasSubstr("impossible size of images"));
}

TEST_F(HostileSession, SamplesHaveTimesAndAnOrder) {
  change("frame", kFrame, "UPDATE frame SET t = NULL");
  EXPECT_THAT(errorOfReading(), HasSubstr("a sample has no time"));
  change("frame", kFrame, "UPDATE frame SET t = 1.0, seq = -9223372036854775808");
  EXPECT_THAT(errorOfReading(), HasSubstr("not in order"));
}

TEST_F(HostileSession, TheRegistrationIsARigidTransform) {  // nan and a scaled rotation were taken
  for (const char* pose : {"nan 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1", "1 0 0"}) {
    change("header", "key, value",
           std::string("INSERT OR REPLACE INTO header VALUES ('registration', '") + pose + "', 0)");
    EXPECT_THAT(errorOfReading(), HasSubstr("is no rigid transform")) << pose;
  }
}

TEST_F(HostileSession,
       RecoveryOfVersion1TakesNoImpossibleRows) {  // seq overflowed, 12 exabytes were asked for
  makeOld();
  run("INSERT INTO motor (seq, t) VALUES (9223372036854775807, 1.0), (-9223372036854775808, 2.0), (-1, 3.0);"
      "INSERT INTO frame (seq, t, codec, width, height) VALUES (77, 1.0, 5, 2000000000, 2000000000), (78, "
      "1.0, 6, 4294967360, 48);"
      "INSERT INTO header VALUES (NULL, 'x')");
  const auto to = folder_ / "new.capstan";
  const Recovery recovery = recoverSession(path_, to);
  EXPECT_EQ(recovery.saved(), 21);
  EXPECT_EQ(recovery.lost_rows, 0);
  EXPECT_EQ(recovery.tables[kMotorTable].damaged, 3);
  EXPECT_EQ(recovery.tables[kFrameTable].damaged, 2);
  EXPECT_EQ(faultOf(to), "");
}

TEST_F(HostileSession, ARecoveredSessionHasNoDamagedRegistration) {  // and could not be opened
  makeOld();
  run("INSERT INTO header VALUES ('registration', '-0 -1 -0 -0.06 -0 0 1 -0.55 -1 0 -0 0.02X9 0 0 0 1')");
  const auto to = folder_ / "new.capstan";
  const Recovery recovery = recoverSession(path_, to);
  EXPECT_THAT(recovery.lost_header, ::testing::Contains("registration"));
  EXPECT_FALSE(recovery.complete());
  EXPECT_EQ(faultOf(to), "");
}

TEST_F(HostileSession, NumbersOfRowsHaveALimit) {
  EXPECT_FALSE(parseRowCounts(
      "motor 9223372036854775807, joint 9223372036854775807, tip 0, frame 0, estimate 0, event 0"));
  EXPECT_FALSE(parseRowCounts("motor -1, joint 0, tip 0, frame 0, estimate 0, event 0"));
  EXPECT_TRUE(parseRowCounts("motor 7, joint 0, tip 0, frame 0, estimate 0, event 0"));
}

/// A database of 512-byte pages. Nine cells of each of 1800 leaves have the same 100 KB of overflow
/// pages: 1.6 GB in 1 MB.
TEST(HostilePages, OverflowPagesOfEveryCellAreReadAFewTimes) {
  constexpr std::size_t kPage = 512, kPages = 2000, kFirstLeaf = 201, kCells = 9, kCell = 47,
                        kFirstOverflow = 3;
  std::string cell("\x86\x8d\x59\x01\x04\x8c\x9b\x36", 8);  // size 100,057, row 1, one blob of 100,053 bytes
  cell.resize(kCell - 4, 'x');
  cell += std::string("\0\0\0\x03", 4);  // the first overflow page
  std::string file(kPage * kPages, '\0');
  file.replace(0, 16, std::string("SQLite format 3\0", 16));
  file[16] = 2;
  for (std::size_t page = kFirstOverflow; page < kFirstLeaf; ++page)
    file[(page - 1) * kPage + 3] = static_cast<char>(page + 1);  // the next one
  for (std::size_t page = kFirstLeaf; page < kPages; ++page) {
    const std::size_t at = page * kPage;
    file[at] = 0x0d, file[at + 4] = kCells;
    for (std::size_t i = 0; i < kCells; ++i) {
      const std::size_t begin = 64 + kCell * i;
      file[at + 8 + 2 * i] = static_cast<char>(begin >> 8U);
      file[at + 9 + 2 * i] = static_cast<char>(begin & 0xffU);
      file.replace(at + begin, kCell, cell);
    }
  }
  const TemporaryFolder folder;
  std::ofstream(folder / "pages.capstan", std::ios::binary) << file;
  SqlitePages pages(folder / "pages.capstan", kPage);
  std::uint64_t rows = 0;
  const PageCounts counts = pages.scan(
      [&](StoredRow&& row) {
        ++rows;
        ASSERT_EQ(row.values.size(), 1U);
        EXPECT_EQ(std::get<std::vector<std::uint8_t>>(row.values[0]).size(), 100'053U);
      },
      nullptr);
  EXPECT_GT(rows, 0U);
  EXPECT_LE(rows * 100'053, 5 * file.size());
  EXPECT_EQ(rows + counts.unreadable, (kPages - kFirstLeaf) * kCells);
}

TEST(HostilePages, CellsThatBeginAtOnePlaceAreOneRow) {
  constexpr std::size_t kPage = 512, kCells = 200, kBegin = 500;
  std::string file(2 * kPage, '\0');
  file.replace(0, 16, std::string("SQLite format 3\0", 16));
  file[16] = 2;
  file[kPage] = 0x0d, file[kPage + 4] = static_cast<char>(kCells);
  for (std::size_t i = 0; i < kCells; ++i)
    file[kPage + 8 + 2 * i] = kBegin >> 8U, file[kPage + 9 + 2 * i] = static_cast<char>(kBegin & 0xffU);
  file.replace(kPage + kBegin, 5, std::string("\x03\x01\x02\x01\x07", 5));  // row 1 with the integer 7
  const TemporaryFolder folder;
  std::ofstream(folder / "pages.capstan", std::ios::binary) << file;
  int rows = 0;
  const PageCounts counts =
      SqlitePages(folder / "pages.capstan", kPage).scan([&](StoredRow&&) { ++rows; }, nullptr);
  EXPECT_EQ(rows, 1);
  EXPECT_EQ(counts.unreadable, kCells - 1);
}

}  // namespace
}  // namespace capstan::recording
