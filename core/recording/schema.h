#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// Tables and columns of a session file, declared once: creation, dictionary, inserting, reading and export
/// use this declaration.
///
/// Real columns carry no declared type, so that SQLite keeps every double as it is (a REAL column would lose
/// the sign of a negative zero); typeof() of their values is `real` or `null`.
namespace capstan::recording {

inline constexpr std::int32_t kApplicationId = 0x43505354;  ///< "CPST"
inline constexpr std::int32_t kSchemaVersion = 1;           ///< PRAGMA user_version
/// Value of `reference` in the header where joints are the robot's own kinematics; else 1 or 0.
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
  std::span<const Column> columns;  ///< `seq` first in tables of samples: its primary key
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
/// INSERT of a whole row, one parameter a column.
std::string insertStatement(const Table& table);
/// SELECT of all columns in order of `seq`.
std::string selectStatement(const Table& table);

}  // namespace capstan::recording
