#include "core/recording/recover.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "core/base/part_file.h"
#include "core/recording/row_check.h"
#include "core/recording/schema.h"
#include "core/recording/session_reader.h"
#include "core/recording/session_writer.h"

namespace capstan::recording {
namespace {

constexpr std::uint64_t kRowsPerCommit = 20'000;
constexpr std::string_view kHeaderKeys[] = {"title", "robot", "camera_left", "camera_right", "tracking"};

bool cancelled(const base::Progress* progress) { return progress && progress->cancelled(); }

bool fits(const Value& value, ColumnType type) {
  if (std::holds_alternative<std::monostate>(value)) return true;
  switch (type) {
    case ColumnType::kReal:
      return std::holds_alternative<double>(value);
    case ColumnType::kInteger:
      return std::holds_alternative<std::int64_t>(value);
    case ColumnType::kText:
      return std::holds_alternative<std::string>(value);
    case ColumnType::kBlob:
      return std::holds_alternative<std::vector<std::uint8_t>>(value);
  }
  return false;
}

/// Whether the values can be a row of the table, with or without a check sum behind them.
bool fits(const StoredRow& row, const Table& table, bool checked) {
  if (row.values.size() != table.columns.size() + checked) return false;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (!fits(row.values[i], table.columns[i].type)) return false;
  return true;
}

bool verified(const StoredRow& row, const Table& table) {
  RowCheck check(table.name);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    struct {
      RowCheck& check;
      void operator()(std::monostate) const { check.addNull(); }
      void operator()(std::int64_t value) const { check.add(value); }
      void operator()(double value) const { check.add(value); }
      void operator()(const std::string& value) const { check.addText(value); }
      void operator()(const std::vector<std::uint8_t>& value) const { check.addBlob(value); }
    } add{check};
    std::visit(add, row.values[i]);
  }
  const auto* crc = std::get_if<std::int64_t>(&row.values.back());
  return crc && *crc == check.value();
}

/// Writes saved rows into the new file.
class Rescue {
 public:
  Rescue(SessionWriter& writer, bool checked) : writer_(writer), checked_(checked) {
    for (const Table& table : tables())
      inserts_.push_back({&table, std::make_unique<Statement>(writer.database(),
                                                              insertStatement(table, "INSERT OR REPLACE"))});
    writer_.begin();
  }

  void take(StoredRow&& row) {
    const Target* near = nullptr;
    for (const Target& target : inserts_) {
      if (row.values.size() != target.table->columns.size() + checked_) continue;
      const bool keyed = target.table->columns[0].type == ColumnType::kInteger;
      if (keyed && std::holds_alternative<std::monostate>(row.values[0])) row.values[0] = row.id;
      const bool fitting = fits(row, *target.table, checked_);
      if (fitting && (!checked_ || verified(row, *target.table))) return insert(row, target);
      if (fitting || !near) near = &target;
    }
    if (near) ++damaged_[near->table];
  }

  void finish() {
    writer_.commit();
    inserts_.clear();
  }

  std::int64_t damaged(const Table& table) { return damaged_[&table]; }
  const std::set<std::string>& headerKeys() const { return keys_; }
  const std::string& writtenRows() const { return written_; }

 private:
  struct Target {
    const Table* table;
    std::unique_ptr<Statement> insert;
  };

  void insert(const StoredRow& row, const Target& target) {
    if (target.table == &dictionaryTable()) return;  // the new file has its own
    if (target.table == &headerTable()) {
      const auto& key = std::get<std::string>(row.values[0]);
      const auto* value = std::get_if<std::string>(&row.values[1]);
      keys_.insert(key);
      if (key == "rows") {
        written_ = value ? *value : "";
        return;
      }
    }
    for (std::size_t i = 0; i < target.table->columns.size(); ++i) bind(*target.insert, i, row.values[i]);
    target.insert->execute();
    if (++rows_ % kRowsPerCommit != 0) return;
    writer_.commit();
    writer_.begin();
  }

  static void bind(Statement& statement, std::size_t column, const Value& value) {
    struct {
      Statement& statement;
      int index;
      void operator()(std::monostate) const { statement.bindNull(index); }
      void operator()(std::int64_t value) const { statement.bind(index, value); }
      void operator()(double value) const { statement.bind(index, value); }
      void operator()(const std::string& value) const { statement.bind(index, std::string_view(value)); }
      void operator()(const std::vector<std::uint8_t>& value) const {
        statement.bind(index, std::span<const std::uint8_t>(value));
      }
    } to{statement, static_cast<int>(column) + 1};
    std::visit(to, value);
  }

  SessionWriter& writer_;
  const bool checked_;
  std::vector<Target> inserts_;
  std::map<const Table*, std::int64_t> damaged_;
  std::set<std::string> keys_;
  std::string written_;
  std::uint64_t rows_ = 0;
};

/// Numbers of rows by table, from the text of countsOf().
std::map<std::string, std::int64_t> parseCounts(const std::string& text) {
  std::map<std::string, std::int64_t> counts;
  std::istringstream words(text);
  std::string name, number;
  while (words >> name >> number) counts[name] = std::strtoll(number.c_str(), nullptr, 10);
  return counts;
}

/// Codecs of saved frames whose own rows are lost: all of a size are alike.
void restoreCodecs(Database& database) {
  std::vector<std::array<std::int64_t, 3>> lost;
  {
    Statement rows(
        database,
        "SELECT DISTINCT codec, width, height FROM frame WHERE codec NOT IN (SELECT id FROM codec)");
    while (rows.step()) lost.push_back({rows.integer(0), rows.integer(1), rows.integer(2)});
  }
  Statement insert(database, insertStatement(codecTable(), "INSERT OR REPLACE"));
  for (const auto& [id, width, height] : lost) {
    const FrameEncoder encoder(static_cast<int>(width), static_cast<int>(height));
    bindCodec(insert, id, encoder.parameters());
    insert.execute();
  }
}

/// Gaps of `seq` over all tables.
void findLost(Database& database, Recovery& recovery) {
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
    if (next == rows.size()) return;
    const std::int64_t seq = rows[next]->integer(0);
    const double now = rows[next]->real(1);
    const std::int64_t gap = seq - last - 1;
    if (gap > 0 && !(first && seq == 0)) {
      recovery.lost_rows += gap;
      if (recovery.lost.size() < kMostLost) recovery.lost.push_back({gap, first ? now : t, now});
    }
    last = seq, t = now;
    more[next] = rows[next]->step();
  }
}

void addTables(Database& database, Rescue& rescue, Recovery& recovery) {
  const std::map<std::string, std::int64_t> written = parseCounts(rescue.writtenRows());
  for (int k = 0; k < kSampleTables; ++k) {
    const Table& table = recording::table(static_cast<SampleTable>(k));
    RecoveredRows rows{std::string(table.name),
                       database.number(fmt::format("SELECT count(*) FROM {}", table.name)),
                       rescue.damaged(table),
                       {}};
    if (const auto found = written.find(rows.table); found != written.end()) rows.written = found->second;
    recovery.tables.push_back(std::move(rows));
  }
}

/// Completes the header of the new file. Throws base::InputError if there is no robot.
void completeHeader(const std::filesystem::path& from, const RecoverOptions& options, SessionWriter& writer,
                    Rescue& rescue, Recovery& recovery) {
  for (const std::string_view key : kHeaderKeys)
    if (!rescue.headerKeys().contains(std::string(key))) recovery.lost_header.emplace_back(key);
  if (rescue.headerKeys().contains("robot")) return;
  if (options.robot.empty())
    throw base::InputError({from.string(), 0, "robot", {}, "is lost", "Give the robot file: --robot FILE"});
  writer.setRobot(options.robot);
}

}  // namespace

std::int64_t Recovery::saved() const {
  std::int64_t sum = 0;
  for (const RecoveredRows& table : tables) sum += table.saved;
  return sum;
}

bool isRecoverable(const base::InputError& error) { return error.fault().remedy == kRecoverRemedy; }

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
    return error.fault().reason;
  } catch (const SqliteError& error) {
    return error.what();
  }
}

Recovery recoverSession(const std::filesystem::path& from, const std::filesystem::path& to,
                        const RecoverOptions& options, base::Progress* progress) {
  Recovery recovery;
  SqlitePages pages(from, kPageSize);
  recovery.checked = pages.version().value_or(kSchemaVersion) != 1;
  if (progress) progress->report(0.0, "verifying");
  recovery.fault = faultOf(from, progress);
  base::PartFile part(to);
  try {
    SessionWriter writer(part.path(), {}, SessionWriter::Durability::kPlain);
    Rescue rescue(writer, recovery.checked);
    recovery.pages = pages.scan([&](StoredRow&& row) {
      rescue.take(std::move(row));
      return !cancelled(progress);
    });
    rescue.finish();
    addTables(writer.database(), rescue, recovery);
    if (cancelled(progress) || recovery.saved() == 0) return recovery;
    writer.begin();
    completeHeader(from, options, writer, rescue, recovery);
    restoreCodecs(writer.database());
    writer.commit();
    findLost(writer.database(), recovery);
    writer.finish();
  } catch (const SqliteError& error) {
    throw base::InputError({to.string(),
                            0,
                            {},
                            {},
                            fmt::format("cannot be written: {}", error.what()),
                            "Check the folder, its permissions and the space"});
  }
  part.commit();
  return recovery;
}

}  // namespace capstan::recording
