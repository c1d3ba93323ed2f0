#include "core/recording/recover.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "core/base/part_file.h"
#include "core/base/yaml.h"
#include "core/recording/row_counts.h"
#include "core/recording/row_rescue.h"
#include "core/recording/schema.h"
#include "core/recording/session_reader.h"
#include "core/recording/session_writer.h"
#include "core/robot/description.h"

namespace capstan::recording {
namespace {

constexpr std::string_view kHeaderKeys[] = {"title",        "created", "software", "robot",    "camera_left",
                                            "camera_right", "truth",   "marker",   "tracking", "reference"};
constexpr const char* kRobotRemedy = "Give the robot file: --robot FILE";
constexpr double kApart = 0.05;                 // lost rows closer than this are stated together [s]
constexpr std::uint32_t kLikelyVersions = 100;  // a higher schema version is damage

bool cancelled(const base::Progress* progress) { return progress && progress->cancelled(); }

/// Codecs of saved frames whose own rows are lost: all of a size are alike.
void restoreCodecs(Database& database) {
  std::vector<std::array<std::int64_t, 3>> lost;
  {
    Statement rows(
        database,
        "SELECT DISTINCT codec, width, height FROM frame WHERE codec NOT IN (SELECT id FROM codec)");
    while (lost.size() < kMostCodecs && rows.step())
      lost.push_back({rows.integer(0), rows.integer(1), rows.integer(2)});
  }
  Statement insert(database, insertStatement(codecTable(), "INSERT OR REPLACE"));
  for (const auto& [id, width, height] : lost) {
    const FrameEncoder encoder(static_cast<int>(width), static_cast<int>(height));
    bindCodec(insert, id, encoder.parameters());
    insert.execute();
  }
}

void addLost(const LostRows& rows, Recovery& recovery) {
  recovery.lost_rows += rows.count;
  if (!recovery.lost.empty() && rows.after < recovery.lost.back().before + kApart) {
    recovery.lost.back().count += rows.count;
    recovery.lost.back().before = rows.before;
  } else if (recovery.lost.size() < kMostLost) {
    recovery.lost.push_back(rows);
  }
}

/// Rows that the recording had at its end and that are lost behind the last saved one, at t.
void addEnd(double t, Recovery& recovery) {
  std::int64_t lost = -recovery.lost_rows;
  for (const RecoveredRows& rows : recovery.tables) lost += rows.written.value_or(rows.saved) - rows.saved;
  if (lost <= 0) return;
  recovery.lost_rows += lost;
  if (recovery.lost.size() < kMostLost)
    recovery.lost.push_back({lost, t, std::numeric_limits<double>::quiet_NaN()});
}

/// Gaps of `seq` over all tables. Returns the place and the time of the last row.
std::pair<std::int64_t, double> findLost(Database& database, Recovery& recovery) {
  std::array<std::unique_ptr<Statement>, kSampleTables> rows;
  std::array<bool, kSampleTables> more{};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k] = std::make_unique<Statement>(
        database, fmt::format("SELECT seq, t FROM {} ORDER BY seq", table(static_cast<SampleTable>(k)).name));
    more[k] = rows[k]->step();
  }
  std::int64_t last = 0;
  double t = 0.0;
  for (bool first = true;; first = false) {
    std::size_t next = rows.size();
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (more[k] && (next == rows.size() || rows[k]->integer(0) < rows[next]->integer(0))) next = k;
    if (next == rows.size()) return {last, t};
    const std::int64_t seq = rows[next]->integer(0);
    const double now = rows[next]->real(1);
    const std::int64_t gap = seq - last - 1;
    if (gap > 0 && !(first && seq == 0)) addLost({gap, first ? now : t, now}, recovery);
    last = seq, t = now;
    more[next] = rows[next]->step();
  }
}

void addTables(Database& database, const RowRescue& rescue, Recovery& recovery) {
  const RowCounts saved = rowCounts(database);
  const std::optional<RowCounts> written = parseRowCounts(rescue.writtenRows());
  for (std::size_t k = 0; k < saved.size(); ++k) {
    const Table& table = recording::table(static_cast<SampleTable>(k));
    recovery.tables.push_back({std::string(table.name), saved[k], rescue.damaged(table), {}});
    if (written) recovery.tables.back().written = (*written)[k];
  }
}

/// Completes the header of the new file. Throws base::InputError if there is no robot.
void completeHeader(const std::filesystem::path& from, const RecoverOptions& options, SessionWriter& writer,
                    const RowRescue& rescue, Recovery& recovery) {
  std::set<std::string> wanted = rescue.damagedKeys();
  for (const std::string_view key : kHeaderKeys) wanted.emplace(key);
  for (const std::string& key : wanted)
    if (!rescue.headerKeys().contains(key)) recovery.lost_header.push_back(key);
  if (rescue.headerKeys().contains("robot")) return;
  if (options.robot.empty()) throw base::InputError({from.string(), 0, "robot", {}, "is lost", kRobotRemedy});
  writer.setRobot(options.robot);
}

}  // namespace

std::int64_t Recovery::saved() const {
  std::int64_t sum = 0;
  for (const RecoveredRows& table : tables) sum += table.saved;
  return sum;
}

bool Recovery::complete() const {
  if (whole()) return true;
  const bool known =
      std::ranges::all_of(tables, [](const RecoveredRows& rows) { return rows.written == rows.saved; });
  return known && checked && lost_header.empty();
}

bool isRecoverable(const base::InputError& error) { return error.fault().remedy == kRecoverRemedy; }

RecoverOptions recoverOptions(const std::filesystem::path& robot) {
  return {robot.empty() ? std::string() : base::writeYaml(robot::readDescription(robot))};
}

bool lacksRobot(const base::InputError& error) { return error.fault().remedy == kRobotRemedy; }

std::string faultOf(const std::filesystem::path& session, base::Progress* progress) {
  try {
    readSessionSummary(session);  // verifies the numbers of rows
    Database database = openSession(session);
    if (!hasChecks(database)) {
      Statement check(database, "PRAGMA quick_check(1)");
      if (check.step() && check.text(0) != "ok") return check.text(0);
    }
    for (int k = 0; k < kSampleTables; ++k) {
      Statement rows = rowsOf(database, table(static_cast<SampleTable>(k)));
      while (!cancelled(progress) && rows.step()) {
      }
    }
    readCodecs(database, session.string());
    return {};
  } catch (const base::InputError& error) {
    constexpr std::string_view kDamaged = "is damaged: ";
    const std::string& reason = error.fault().reason;
    return reason.starts_with(kDamaged) ? reason.substr(kDamaged.size()) : reason;
  } catch (const SqliteError& error) {
    return error.what();
  }
}

namespace {

/// Throws base::InputError for files that are no matter of recovery.
void checkFiles(const std::filesystem::path& from, const std::filesystem::path& to,
                const SqlitePages& pages) {
  for (const char* suffix : {"-wal", "-shm", "-journal"})
    if (std::filesystem::weakly_canonical(to) == std::filesystem::weakly_canonical(from.string() + suffix))
      throw base::InputError({to.string(), 0, {}, {}, "belongs to " + from.string(), "Choose another name"});
  const std::uint32_t version = pages.version().value_or(kSchemaVersion);
  if (version > kSchemaVersion && version < kLikelyVersions)
    throw base::InputError(
        {from.string(),
         0,
         {},
         {},
         fmt::format("has schema version {}, this program knows up to {}", version, kSchemaVersion),
         "Recover it with a newer Capstan"});
}

/// Holds a read transaction, so that a recorder in another process does not begin its log again meanwhile.
std::unique_ptr<Database> heldOpen(const std::filesystem::path& session) {
  try {
    auto database = std::make_unique<Database>(session, Database::Mode::kRead);
    database->run("BEGIN; SELECT count(*) FROM header");
    return database;
  } catch (const SqliteError&) {
    return nullptr;  // SQLite cannot read it
  }
}

/// What contradicts a file in which no fault was found.
std::string contradictionOf(const Recovery& recovery, const std::filesystem::path& from) {
  const SessionSummary all = readSessionSummary(from);
  const RowCounts counts = {all.motor, all.joint, all.tip, all.frames, all.estimates, all.events};
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (recovery.tables[k].saved < counts[k])
      return fmt::format("only {} of {} rows of table {} could be saved", recovery.tables[k].saved, counts[k],
                         recovery.tables[k].table);
  return recovery.lost_header.empty() ? "" : "entries of the header are missing";
}

std::uint64_t rowsAsWritten(SqlitePages& pages, const base::Progress* progress) {
  std::uint64_t rows = 0;
  pages.scan([&](StoredRow&& row) { rows += isAsWritten(std::move(row)); }, progress);
  return rows;
}

/// Pages of a session. If nothing states their size, it is that with which more rows are as they were
/// written; the former size if none is, since former sessions have no check sums.
SqlitePages pagesOf(const std::filesystem::path& session, const base::Progress* progress) {
  SqlitePages pages(session, kPageSize);
  if (pages.statesPageSize()) return pages;
  SqlitePages former(session, kFormerPageSize);
  return rowsAsWritten(former, progress) >= rowsAsWritten(pages, progress) ? std::move(former)
                                                                           : std::move(pages);
}

}  // namespace

Recovery recoverSession(const std::filesystem::path& from, const std::filesystem::path& to,
                        const RecoverOptions& options, base::Progress* progress) {
  Recovery recovery;
  if (progress) progress->report(0.0, "verifying");
  SqlitePages pages = pagesOf(from, progress);
  checkFiles(from, to, pages);
  recovery.fault = faultOf(from, progress);
  const auto held = heldOpen(from);
  base::PartFile part(to);
  try {
    SessionWriter writer(part.path(), {}, SessionWriter::Durability::kPlain);
    RowRescue rescue(writer, pages.version().value_or(1) == 1);
    recovery.pages = pages.scan([&](StoredRow&& row) { rescue.take(std::move(row)); }, progress);
    rescue.finish();
    recovery.checked = !rescue.unchecked();
    addTables(writer.database(), rescue, recovery);
    if (cancelled(progress) || recovery.saved() == 0) return recovery;
    writer.begin();
    completeHeader(from, options, writer, rescue, recovery);
    restoreCodecs(writer.database());
    const auto [last, t] = findLost(writer.database(), recovery);
    addEnd(t, recovery);
    if (recovery.whole()) recovery.fault = contradictionOf(recovery, from);
    if (!recovery.complete())
      writer.write(last + 1, SessionEvent{t, "recorder",
                                          fmt::format("recovered from {}: {} rows lost",
                                                      from.filename().string(), recovery.lost_rows)});
    writer.commit();
    writer.finish();
  } catch (const SqliteError& error) {
    throw base::InputError({to.string(),
                            0,
                            {},
                            {},
                            fmt::format("cannot be written: {}", error.what()),
                            "Check the folder, its permissions and the space"});
  }
  foldLog(to);
  part.commit();
  return recovery;
}

}  // namespace capstan::recording
