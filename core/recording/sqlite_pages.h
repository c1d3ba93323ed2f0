#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "core/base/progress.h"

/// Rows of an SQLite 3 database, read from its pages without SQLite (SQLite, Database File Format): those of
/// a damaged file that can still be read. For core/recording only.
namespace capstan::recording {

/// A stored value: NULL, INTEGER, REAL, TEXT or BLOB.
using Value = std::variant<std::monostate, std::int64_t, double, std::string, std::vector<std::uint8_t>>;

/// A row as it is stored; a column that is INTEGER PRIMARY KEY is NULL and its value is the row id.
struct StoredRow {
  std::int64_t id = 0;
  std::vector<Value> values;
};

/// What a scan of the pages met.
struct PageCounts {
  std::uint64_t pages = 0;          ///< pages in the file and its write-ahead log
  std::uint64_t unreadable = 0;     ///< cells of table leaves that are no row, or overlap others
  std::uint64_t missing = 0;        ///< pages that the file's header states and the file lacks
  std::uint64_t missing_bytes = 0;  ///< size of these
};

/// Pages of a database file and of the write-ahead log beside it.
class SqlitePages {
 public:
  /// Throws base::InputError if `path` cannot be read.
  /// `page_size` is used if the headers of the file and of its log are damaged.
  SqlitePages(const std::filesystem::path& path, std::uint32_t page_size);

  /// Whether the header of the file, or of its log, states the page size.
  bool statesPageSize() const { return states_page_size_; }
  /// Schema version (PRAGMA user_version) in the file's header; nothing if the header is damaged.
  std::optional<std::uint32_t> version() const { return version_; }
  /// Hands every row of every table leaf but those of page 1 (the schema) to `row`, in the order of the
  /// pages; rows of the log come last. Stops when `progress` is cancelled.
  PageCounts scan(const std::function<void(StoredRow&&)>& row, const base::Progress* progress);

 private:
  void readHeader();
  void readLog();
  bool read(std::ifstream& from, std::uint64_t offset, std::vector<std::uint8_t>& page) const;
  std::optional<std::vector<std::uint8_t>> payload(const std::vector<std::uint8_t>& page, std::size_t at,
                                                   std::uint64_t size);
  bool readPage(std::uint32_t number, std::vector<std::uint8_t>& page);
  std::optional<StoredRow> rowAt(const std::vector<std::uint8_t>& page, std::size_t at);
  bool scanPage(const std::vector<std::uint8_t>& page, PageCounts& counts,
                const std::function<void(StoredRow&&)>& row, const base::Progress* progress);

  void takePageSize(std::uint32_t stated);

  std::uint32_t page_size_, reserved_ = 0;  ///< [bytes]; reserved at the end of each page
  bool states_page_size_ = false;
  std::ifstream file_, log_;
  std::uint64_t file_bytes_ = 0;
  std::optional<std::uint32_t> version_;
  std::uint32_t stated_pages_ = 0;
  struct LogPage {
    std::uint32_t number;
    std::uint64_t offset;
  };
  std::vector<LogPage> log_pages_;  ///< in the order of writing
  std::unordered_map<std::uint32_t, std::uint64_t>
      newest_;                       ///< offset of the newest version of a page in the log
  std::uint64_t overflow_left_ = 0;  ///< bytes of overflow pages that the scan may still read
};

}  // namespace capstan::recording
