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
inline constexpr std::int32_t kSchemaVersion = 1;           ///< PRAGMA user_version
/// Value of `reference` in the header if joints are the robot's own kinematics; otherwise it is 1 or 0.
inline constexpr std::string_view kOwnKinematics = "own kinematics";

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
  std::span<const Column> columns;  ///< tables of samples begin with `seq`, their primary key
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

std::string createStatement(const Table& table);
/// INSERT statement of a whole row, one parameter per column.
std::string insertStatement(const Table& table);
/// SELECT statement of all columns, ordered by `seq`.
std::string selectStatement(const Table& table);

}  // namespace capstan::recording
