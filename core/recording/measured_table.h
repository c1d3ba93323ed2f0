#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/table_files/named_column.h"
#include "core/table_files/read_columns.h"
#include "core/table_files/table_lines.h"

namespace capstan::recording {

/// Columns of one quantity over all joints (or axes): column(i)[row]. Empty: the table has no such columns.
using TableColumns = std::vector<std::vector<double>>;

/// The measured table (resources/manual/measured-table.md) for n joints (1–7): t, q_m1..n, dq_m1..n,
/// tau_m1..n, q1..n, p_c1..3, tau_ext1..n; SI units; an empty cell is NaN.
struct MeasuredTable {
  std::string file;
  table_files::TableLines lines;     ///< where the rows are in the file
  std::vector<double> t;             ///< strictly increasing [s]
  TableColumns q_m;                  ///< motor position from the hard stop [rad]
  TableColumns dq_m;                 ///< [rad/s]
  TableColumns tau_m;                ///< [N·m or N]
  TableColumns q;                    ///< joint encoders, the reference [rad or m]
  TableColumns p_c;                  ///< tip from the cameras, frame 0 [m]
  TableColumns tau_ext;              ///< measured external joint load [N·m or N]
  bool own_kinematics = false;       ///< q is computed by the robot from its motors and is no reference
  std::vector<std::string> ignored;  ///< columns of the table that are not used

  std::size_t rows() const { return t.size(); }
  int joints() const;  ///< number of joints n: the largest number of columns of a joint quantity
};

/// Reads the table at `path`, a file of any kind of table_files::tableKinds(). Columns may have any order,
/// and whole quantities may be missing. Throws base::InputError with file, line, column, value and remedy for
/// a missing t, a cell that is not a number, a wrong number of cells, t not strictly increasing, a joint's
/// column missing between others (q_m1, q_m3), or a column given twice.
MeasuredTable readMeasuredTable(const std::filesystem::path& path);
/// The same of columns that are in memory; `file` names them in errors.
MeasuredTable readMeasuredTable(const table_files::ColumnReader& columns, const std::string& file);
/// Parses the text of such a CSV; `file` names it in errors.
MeasuredTable parseMeasuredTable(std::string_view text, const std::string& file);
/// The same without the order of times: rows of a live stream, of which some may be repeated.
MeasuredTable parseMeasuredRows(std::string_view text, const std::string& file);
/// Throws base::InputError if an unused column of `table` probably is the column `name`, misspelled.
void refuseMisspelled(const MeasuredTable& table, const std::string& name);
/// Throws base::InputError for the column `name`, which `table` lacks: as refuseMisspelled(), else with
/// `reason` and `remedy`.
[[noreturn]] void refuseMissing(const MeasuredTable& table, const std::string& name,
                                const std::string& reason, const std::string& remedy);
/// Column that `table` lacks and that its unused column `name` probably stands for, as q_m3 for qm3; empty:
/// none.
std::string columnMeantBy(const MeasuredTable& table, const std::string& name);
/// Throws base::InputError for the first row whose time is not above that of the row before; for the first
/// row, `before` [s].
void checkTimes(const MeasuredTable& table, double before);
/// Throws base::InputError for a time that is no number or beyond ±kLongestTime, in a table in SI units.
void checkTimeRange(const MeasuredTable& table);
inline constexpr double kLongestTime = 1e10;  ///< 317 years [s]; clocks count from 1970
/// Removes the rows whose entry in `keep` is false.
void keepRows(MeasuredTable& table, const std::vector<bool>& keep);
/// The columns of the table in the order of a file, with units; those of joints are the ones of `revolute`
/// (true: rad and N·m, false: m and N), or of revolute joints beyond its end. They point into `table`.
std::vector<table_files::NamedColumn> namedColumns(const MeasuredTable& table,
                                                   const std::vector<bool>& revolute = {});
/// Formats the table as CSV with the shortest decimals that read back to the last bit; NaN is an empty cell.
std::string formatMeasuredTable(const MeasuredTable& table);
/// The header line of that CSV, with its line end.
std::string measuredTableHeader(const MeasuredTable& table);
/// The line of one row, with its line end.
std::string formatMeasuredRow(const MeasuredTable& table, std::size_t row);

}  // namespace capstan::recording
