#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// Tables and columns of a session file. Creation, dictionary, insertion, reading and export all use this
/// declaration.
///
/// Columns of real numbers have no declared type, so that SQLite stores every double unchanged (a REAL column
/// would lose the sign of a negative zero). typeof() of their values is `real` or `null`.
namespace capstan::recording {

inline constexpr std::int32_t kApplicationId = 0x43505354;  ///< "CPST"
/// Of the database [bytes]. With 8192 bytes, half of the writer's time for 2 × 720p at 30 frames/s was spent
/// in the kernel, and samples were lost.
inline constexpr int kPageSize = 32768;
/// Of sessions written before the present size was introduced [bytes].
inline constexpr int kFormerPageSize = 8192;
/// PRAGMA user_version. Version 1 had no check sums.
inline constexpr std::int32_t kSchemaVersion = 2;
inline constexpr std::string_view kCheckColumn = "crc";  ///< last column of each table, RowCheck
/// Value of `reference` in the header if joints are the robot's own kinematics; otherwise it is 1 or 0.
inline constexpr std::string_view kOwnKinematics = "own kinematics";

inline constexpr std::int64_t kMostRows = std::int64_t{1} << 48;  ///< and largest `seq`; more is damage

enum class ColumnType { kReal, kInteger, kText, kBlob };

struct Column {
  std::string_view name;
  ColumnType type;
  std::string_view unit;  ///< SI; empty: none
  std::string_view meaning;
};

struct Table {
  std::string_view name;
  std::string_view meaning;
  /// All columns but kCheckColumn. Tables of samples begin with `seq`, their primary key.
  std::span<const Column> columns;
};

/// Tables of samples, in the order in which they are counted, replayed and exported.
enum SampleTable {
  kMotorTable,
  kJointTable,
  kTipTable,
  kFrameTable,
  kEstimateTable,
  kEventTable,
  kSampleTables
};

/// All tables: those of SampleTable first, then `codec`, `header` and `dictionary`.
std::span<const Table> tables();
const Table& table(SampleTable which);
const Table& codecTable();
const Table& headerTable();
const Table& dictionaryTable();
extern const Column kCheck;  ///< the column kCheckColumn

std::string createStatement(const Table& table);
/// INSERT statement of a whole row, one parameter per column; the check sum is computed.
std::string insertStatement(const Table& table, std::string_view verb = "INSERT");
/// SELECT of all columns, without WHERE and ORDER BY. Steps fail at a row that is not as it was written
/// (row_holds()), unless the file has no check sums.
std::string selectStatement(const Table& table, bool checked);

}  // namespace capstan::recording
