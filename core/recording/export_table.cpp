#include "core/recording/export_table.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/base/software.h"
#include "core/recording/export.h"
#include "core/recording/schema.h"
#include "core/recording/session_reader.h"
#include "core/table_files/write_columns.h"

namespace capstan::recording {
namespace {

using table_files::NamedColumn;

constexpr std::size_t kPiece = 1U << 14;  ///< rows of a session that are in memory at once
constexpr std::array kGroups = {kMotorTable, kJointTable, kTipTable, kFrameTable, kEstimateTable};

std::vector<bool> revoluteJoints(const robot::Description& robot) {
  std::vector<bool> all;
  for (const robot::Joint& joint : robot.joints) all.push_back(joint.type == robot::JointType::kRevolute);
  return all;
}

table_files::FileAttributes attributesOf(const robot::Description& robot, const char* format) {
  return {{"format", format},
          {"format_version", "1"},
          {"software", "Capstan " + base::version()},
          {"robot", robot.name},
          {"robot_file", robot::formatDescription(robot)}};
}

/// The columns of numbers of a table of samples, with room for a piece of its rows.
struct Piece {
  explicit Piece(const Table& table) {
    for (const Column& column : table.columns)
      if (column.type == ColumnType::kReal || column.type == ColumnType::kInteger) {
        at.push_back(static_cast<int>(&column - table.columns.data()));
        columns.push_back(
            {std::string(column.name), std::string(column.unit), std::string(column.meaning), nullptr});
      }
    values.resize(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].values = &values[i];
  }
  void add(const Statement& row) {
    for (std::size_t i = 0; i < at.size(); ++i) values[i].push_back(row.real(at[i]));
  }
  void clear() {
    for (std::vector<double>& column : values) column.clear();
  }

  std::vector<int> at;  ///< indices among all columns of the table
  std::vector<NamedColumn> columns;
  std::vector<std::vector<double>> values;
};

void writeSamples(Database& database, const Table& table, table_files::Hdf5Writer& writer,
                  const base::Progress* progress) {
  Piece piece(table);
  writer.beginTable(std::string(table.name), std::string(table.meaning), piece.columns);
  Statement rows = rowsOf(database, table);
  while (rows.step()) {
    piece.add(rows);
    if (piece.values.front().size() < kPiece) continue;
    writer.append(piece.columns);
    piece.clear();
    if (progress && progress->cancelled()) return;
  }
  writer.append(piece.columns);
}

}  // namespace

void writeTable(const MeasuredTable& table, const std::filesystem::path& path,
                const robot::Description& robot, table_files::MatlabVersion matlab) {
  table_files::writeColumns(path, namedColumns(table, revoluteJoints(robot)),
                            attributesOf(robot, "measured table"), matlab);
}

MeasuredTable exportHdf5(const std::filesystem::path& session, const std::filesystem::path& path,
                         base::Progress* progress) {
  MeasuredTable measured = sessionTable(session);
  const robot::Description robot = sessionRobot(session);
  Database database = openSession(session);
  const auto columns = namedColumns(measured, revoluteJoints(robot));
  try {
    table_files::Hdf5Writer writer(path, attributesOf(robot, "session"));
    writer.beginTable("/", "measured table: one row per motor sample", columns);
    writer.append(columns);
    for (const SampleTable which : kGroups) {
      if (progress) progress->report(static_cast<double>(which) / kGroups.size(), table(which).name);
      writeSamples(database, table(which), writer, progress);
      if (progress && progress->cancelled()) return measured;
    }
    writer.commit();
  } catch (const SqliteError& error) {
    throw damagedSession(session, error);
  }
  return measured;
}

robot::Description sessionRobot(const std::filesystem::path& session) {
  Database database = openSession(session);
  try {
    return robot::parseDescription(readHeader(database).robot, session.string());
  } catch (const SqliteError& error) {
    throw damagedSession(session, error);
  }
}

}  // namespace capstan::recording
