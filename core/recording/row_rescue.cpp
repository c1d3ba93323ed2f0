#include "core/recording/row_rescue.h"

#include <span>
#include <utility>
#include <variant>

#include "core/recording/frame_codec.h"
#include "core/recording/row_check.h"

namespace capstan::recording {
namespace {

constexpr std::uint64_t kRowsPerCommit = 20'000;

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

/// An entry of the header with a key; a registration that readers accept.
bool possibleEntry(const StoredRow& row) {
  const auto* key = std::get_if<std::string>(&row.values[0]);
  const auto* value = std::get_if<std::string>(&row.values[1]);
  return key && (*key != "registration" || !value || value->empty() || parsePose(*value));
}

/// Whether the values are possible, which no check sum of a file from a stranger, and none at all in version
/// 1, ensures.
bool possible(const StoredRow& row, const Table& table) {
  const auto integer = [&](std::size_t column) {
    const auto* value = std::get_if<std::int64_t>(&row.values[column]);
    return value ? *value : -1;
  };
  if (&table == &headerTable()) return possibleEntry(row);
  if (&table == &dictionaryTable()) return true;
  if (integer(0) < 0 || integer(0) > kMostRows) return false;  // seq, or the id of a codec
  if (&table == &recording::table(kFrameTable)) return isFrameSize(integer(4), integer(5));
  if (&table == &codecTable()) return isFrameSize(integer(2), integer(3));
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

void bind(Statement& statement, std::size_t column, const Value& value) {
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

/// The row id of a column that is INTEGER PRIMARY KEY, which SQLite stores as NULL.
void restoreKey(StoredRow& row, const Table& table) {
  const bool keyed = table.columns[0].type == ColumnType::kInteger;
  if (keyed && std::holds_alternative<std::monostate>(row.values[0])) row.values[0] = row.id;
}

}  // namespace

bool isAsWritten(StoredRow&& row) {
  for (const Table& table : tables()) {
    if (row.values.size() != table.columns.size() + 1) continue;
    restoreKey(row, table);
    if (fits(row, table, true) && verified(row, table)) return true;
  }
  return false;
}

RowRescue::RowRescue(SessionWriter& writer, bool unchecked) : writer_(writer), unchecked_allowed_(unchecked) {
  for (const Table& table : tables())
    inserts_.push_back({&table, std::make_unique<Statement>(writer.database(),
                                                            insertStatement(table, "INSERT OR REPLACE"))});
  writer_.begin();
}

void RowRescue::take(StoredRow&& row) {
  const Target* near = nullptr;
  for (const Target& target : inserts_) {
    const std::size_t columns = target.table->columns.size();
    const bool checked = row.values.size() == columns + 1;
    if (!checked && !(unchecked_allowed_ && row.values.size() == columns)) continue;
    restoreKey(row, *target.table);
    const bool fitting = fits(row, *target.table, checked) && possible(row, *target.table);
    if (fitting && (!checked || verified(row, *target.table))) {
      unchecked_ |= !checked;
      return insert(row, target);
    }
    if (fitting || !near) near = &target;
  }
  if (near) setAside(row, *near->table);
}

void RowRescue::finish() {
  writer_.commit();
  inserts_.clear();
}

std::int64_t RowRescue::damaged(const Table& table) const {
  const auto found = damaged_.find(&table);
  return found == damaged_.end() ? 0 : found->second;
}

void RowRescue::setAside(const StoredRow& row, const Table& table) {
  ++damaged_[&table];
  const auto* key = std::get_if<std::string>(&row.values[0]);
  if (&table == &headerTable() && key) damaged_keys_.insert(*key);
}

void RowRescue::insert(const StoredRow& row, const Target& target) {
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

}  // namespace capstan::recording
