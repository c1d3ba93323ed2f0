#include "core/recording/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/base/part_file.h"
#include "core/base/table.h"
#include "core/base/yaml.h"
#include "core/recording/disk_space.h"
#include "core/recording/schema.h"
#include "core/recording/session_reader.h"
#include "core/recording/session_source.h"
#include "core/recording/session_writer.h"
#include "core/tracking/arrival.h"

namespace capstan::recording {
namespace {

std::string tableText(Database& database, const Table& table, base::Progress* progress) {
  std::string names;
  std::vector<int> shown;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].type == ColumnType::kBlob) continue;
    names += (names.empty() ? "" : ",") + std::string(table.columns[i].name);
    shown.push_back(static_cast<int>(i));
  }
  std::string text = names + '\n';
  Statement rows = rowsOf(database, table, "ORDER BY rowid");
  while (rows.step()) {
    if (progress && progress->cancelled()) return {};
    for (const int i : shown) {
      if (i > 0) text += ',';
      if (rows.isNull(i)) continue;
      if (rows.isReal(i))
        fmt::format_to(std::back_inserter(text), "{}", rows.real(i));
      else
        text += base::csvQuoted(rows.text(i));
    }
    text += '\n';
  }
  return text;
}

void ensureFolder(const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw base::InputError(
        {folder.string(), 0, {}, {}, "cannot be created: " + fault.message(), "Choose another folder"});
}

void pushRow(TableColumns& columns, const Eigen::Vector3d& value) {
  columns.resize(3);
  for (int i = 0; i < 3; ++i) columns[static_cast<std::size_t>(i)].push_back(value(i));
}

/// Removes quantities without values in any row.
void dropEmpty(TableColumns& columns) {
  for (const auto& column : columns)
    if (std::any_of(column.begin(), column.end(), [](double x) { return !std::isnan(x); })) return;
  columns.clear();
}

/// Index of the last row at or before t.
std::optional<std::size_t> rowAt(const MeasuredTable& table, double t) {
  const auto after = std::upper_bound(table.t.begin(), table.t.end(), t);
  if (after == table.t.begin()) return std::nullopt;
  return static_cast<std::size_t>(after - table.t.begin()) - 1;
}

/// Index of the first row at or after t.
std::optional<std::size_t> rowFrom(const MeasuredTable& table, double t) {
  const auto from = std::lower_bound(table.t.begin(), table.t.end(), t);
  if (from == table.t.end()) return std::nullopt;
  return static_cast<std::size_t>(from - table.t.begin());
}

void placeJoints(Database& database, MeasuredTable& table) {
  Statement rows = rowsOf(database, recording::table(kJointTable));
  while (rows.step())
    if (const auto row = rowFrom(table, rows.real(1)))
      for (std::size_t i = 0; i < 3; ++i) table.q[i][*row] = rows.real(static_cast<int>(2 + i));
}

void placeTips(Database& database, MeasuredTable& table) {
  Statement rows = rowsOf(database, recording::table(kTipTable));
  while (rows.step())
    if (const auto row = rowAt(table, rows.real(1)))
      for (std::size_t i = 0; i < 3; ++i) table.p_c[i][*row] = rows.real(static_cast<int>(3 + i));
}

void reportTime(base::Progress& progress, const tracking::SourceInfo& info, double t) {
  if (info.duration > 0.0)
    progress.report(std::clamp((t - info.begin) / info.duration, 0.0, 1.0), "importing");
}

/// Samples that are certainly in the file.
struct Committed {
  std::int64_t rows = 0;
  double begin = 0.0, end = 0.0;  ///< arrival of the first and last sample [s]
};

/// Throws SqliteError if the disk of `file` has less than its reserve free.
void checkRoom(const std::filesystem::path& file) {
  const DiskSpace space = diskSpaceAt(file.parent_path());
  if (space.size > 0 && space.free < space.reserve)
    throw SqliteError(SQLITE_FULL, "on the disk only the reserve of " + sizeText(space.reserve) + " is free");
}

/// Writes all samples in transactions of 0.2 s of the recording. Throws SqliteError when the disk is full.
void writeSamples(tracking::Source& source, SessionWriter& writer, const std::filesystem::path& file,
                  base::Progress* progress, Committed& committed) {
  constexpr double kCommitPeriod = 0.2;  // [s]
  constexpr std::int64_t kMostRows = 5000;
  tracking::Sample sample;
  std::int64_t seq = 0;
  double t = 0.0;
  const auto begin = [&] {
    checkRoom(file);
    writer.begin();
  };
  const auto commit = [&] {
    writer.commit();
    committed.rows = seq;
    committed.end = t;
  };
  begin();
  while (source.next(sample)) {
    t = tracking::arrivalOf(sample);
    if (seq == 0) committed.begin = committed.end = t;
    std::visit([&](const auto& row) { writer.write(++seq, row); }, sample);
    if (t - committed.end >= kCommitPeriod || seq - committed.rows >= kMostRows) {
      commit();
      begin();
    }
    if (!progress || seq % 256 != 0) continue;
    if (progress->cancelled()) break;
    reportTime(*progress, source.info(), std::visit([](const auto& row) { return row.t; }, sample));
  }
  commit();
}

base::InputError stopped(const std::filesystem::path& session, const SqliteError& error,
                         const Committed& committed, bool kept, bool former) {
  const std::string left =
      kept ? fmt::format("The file is whole and holds the first {:.2f} s", committed.end - committed.begin)
      : former ? "The former file is as it was, what was written is removed"
               : "What was written is removed";
  return base::InputError({session.string(),
                           0,
                           {},
                           {},
                           fmt::format("cannot be written: {}. {}", error.what(), left),
                           error.code() == SQLITE_FULL ? "Free space, or choose another folder"
                                                       : "Check the folder, its permissions and the space"});
}

}  // namespace

std::vector<std::filesystem::path> exportCsv(const std::filesystem::path& session,
                                             const std::filesystem::path& folder, base::Progress* progress) {
  Database database = openSession(session);
  ensureFolder(folder);
  std::vector<std::filesystem::path> files;
  try {
    for (std::size_t i = 0; i < tables().size(); ++i) {
      const Table& table = tables()[i];
      if (progress)
        progress->report(static_cast<double>(i) / static_cast<double>(tables().size()), table.name);
      const std::string text = tableText(database, table, progress);
      if (progress && progress->cancelled()) break;
      files.push_back(folder / (std::string(table.name) + ".csv"));
      base::writeTextFile(files.back(), text);
    }
  } catch (const SqliteError& error) {
    throw damagedSession(session, error);
  }
  return files;
}

MeasuredTable sessionTable(const std::filesystem::path& session) {
  Database database = openSession(session);
  MeasuredTable table;
  table.file = session.string();
  try {
    table.own_kinematics = readHeader(database).own_kinematics;
    Statement rows = rowsOf(database, recording::table(kMotorTable));
    while (rows.step()) {
      table.t.push_back(rows.real(1));
      pushRow(table.q_m, {rows.real(2), rows.real(3), rows.real(4)});
      pushRow(table.dq_m, {rows.real(5), rows.real(6), rows.real(7)});
      pushRow(table.tau_m, {rows.real(8), rows.real(9), rows.real(10)});
    }
    table.q.assign(3, std::vector<double>(table.rows(), base::kNaN));
    table.p_c = table.q;
    placeJoints(database, table);
    placeTips(database, table);
  } catch (const SqliteError& error) {
    throw damagedSession(session, error);
  }
  for (TableColumns* columns : {&table.dq_m, &table.tau_m, &table.q, &table.p_c}) dropEmpty(*columns);
  return table;
}

void importRecording(tracking::Source& source, const std::filesystem::path& session,
                     const SessionHeader& header, base::Progress* progress, Existing existing,
                     OnFullDisk on_full_disk) {
  const bool former = std::filesystem::exists(session);
  if (existing == Existing::kRefuse && former)
    throw base::InputError({session.string(), 0, {}, {}, "exists already", "Choose another name"});
  base::PartFile part(session);
  Committed committed;
  try {
    SessionWriter writer(part.path(), header, SessionWriter::Durability::kPlain);
    try {
      writeSamples(source, writer, part.path(), progress, committed);
      writer.finish();
    } catch (const SqliteError&) {
      writer.rollback();
      writer.finish();
      throw;
    }
  } catch (const SqliteError& error) {
    const bool kept = on_full_disk == OnFullDisk::kKeep && !former && committed.rows > 0;
    if (kept) {
      foldLog(part.target());
      part.commit();
    }
    throw stopped(session, error, committed, kept, former);
  }
  if (progress && progress->cancelled()) return;
  foldLog(part.target());
  part.commit();
}

}  // namespace capstan::recording
