#include "core/recording/sqlite_pages.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>

#include "core/base/error.h"

namespace capstan::recording {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kTableLeaf = 0x0D;
constexpr std::uint32_t kSmallestPage = 512, kLargestPage = 65536;
constexpr std::size_t kLeafHeader = 8, kLogHeader = 32, kFrameHeader = 24;
constexpr std::size_t kMostValues = 64;          ///< of a row; more is damage
constexpr std::uint64_t kMostReads = 4;          ///< of an overflow page, on average
constexpr std::uint64_t kMostPayload = 1 << 28;  ///< of a row [bytes]; more is damage

std::uint32_t big16(const std::uint8_t* at) { return static_cast<std::uint32_t>(at[0] << 8 | at[1]); }
std::uint32_t big32(const std::uint8_t* at) { return big16(at) << 16 | big16(at + 2); }

/// Variable-length integer at `at`, which moves past it; nothing beyond the end.
std::optional<std::uint64_t> varint(const Bytes& bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (int i = 0; i < 9; ++i) {
    if (at >= bytes.size()) return std::nullopt;
    const std::uint8_t byte = bytes[at++];
    if (i == 8) return value << 8 | byte;
    value = value << 7 | (byte & 0x7f);
    if (!(byte & 0x80)) return value;
  }
  return value;
}

/// Number of bytes of a value of this serial type.
std::uint64_t sizeOf(std::uint64_t type) {
  constexpr std::uint64_t kFixed[] = {0, 1, 2, 3, 4, 6, 8, 8, 0, 0, 0, 0};
  return type < 12 ? kFixed[type] : (type - 12) / 2;
}

std::int64_t integerAt(const std::uint8_t* at, std::uint64_t size) {
  std::uint64_t value = size > 0 && at[0] & 0x80 ? ~std::uint64_t{0} : 0;
  for (std::uint64_t i = 0; i < size; ++i) value = value << 8 | at[i];
  return static_cast<std::int64_t>(value);
}

std::optional<Value> valueAt(const Bytes& payload, std::size_t at, std::uint64_t type) {
  const std::uint64_t size = sizeOf(type);
  if (size > payload.size() - at) return std::nullopt;
  const std::uint8_t* bytes = payload.data() + at;
  if (type == 0) return Value();
  if (type <= 6) return Value(integerAt(bytes, size));
  if (type == 7) return Value(std::bit_cast<double>(integerAt(bytes, size)));
  if (type <= 9) return Value(static_cast<std::int64_t>(type - 8));
  if (type < 12) return std::nullopt;  // reserved
  if (type % 2 == 0) return Value(Bytes(bytes, bytes + size));
  return Value(std::string(reinterpret_cast<const char*>(bytes), size));
}

}  // namespace

SqlitePages::SqlitePages(const std::filesystem::path& path, std::uint32_t page_size)
    : page_size_(page_size), file_(path, std::ios::binary), log_(path.string() + "-wal", std::ios::binary) {
  std::error_code fault;
  file_bytes_ = std::filesystem::file_size(path, fault);
  if (!file_ || fault)
    throw base::InputError(
        {path.string(), 0, {}, {}, "cannot be read", "Check the path and its permissions"});
  readHeader();
  readLog();
}

void SqlitePages::readHeader() {
  constexpr char kMagic[] = "SQLite format 3";
  Bytes head(100);
  if (!read(file_, 0, head) || std::memcmp(head.data(), kMagic, sizeof kMagic) != 0) return;
  takePageSize(big16(&head[16]) == 1 ? kLargestPage : big16(&head[16]));
  if (states_page_size_) reserved_ = head[20];
  version_ = big32(&head[60]);
  stated_pages_ = big32(&head[28]);
}

void SqlitePages::takePageSize(std::uint32_t stated) {
  if (!std::has_single_bit(stated) || stated < kSmallestPage || stated > kLargestPage) return;
  page_size_ = stated;
  states_page_size_ = true;
}

/// Frames of the log that were written since it was last moved into the file: those with its salts.
void SqlitePages::readLog() {
  constexpr std::uint32_t kMagic = 0x377f0682;  // and this plus one
  Bytes head(kLogHeader), frame(kFrameHeader);
  if (!log_ || !read(log_, 0, head)) return;
  if (!states_page_size_ && (big32(head.data()) & ~1U) == kMagic) takePageSize(big32(&head[8]));
  for (std::uint64_t at = kLogHeader; read(log_, at, frame); at += kFrameHeader + page_size_) {
    if (std::memcmp(&head[16], &frame[8], 8) != 0) break;
    log_pages_.push_back({big32(frame.data()), at + kFrameHeader});
    newest_[log_pages_.back().number] = log_pages_.back().offset;
  }
}

bool SqlitePages::read(std::ifstream& from, std::uint64_t offset, Bytes& page) const {
  from.clear();
  from.seekg(static_cast<std::streamoff>(offset));
  from.read(reinterpret_cast<char*>(page.data()), static_cast<std::streamsize>(page.size()));
  return from.gcount() == static_cast<std::streamsize>(page.size());
}

/// The newest version of a page, from 1.
bool SqlitePages::readPage(std::uint32_t number, Bytes& page) {
  page.resize(page_size_);
  if (const auto newest = newest_.find(number); newest != newest_.end())
    return read(log_, newest->second, page);
  return number > 0 && read(file_, std::uint64_t{number - 1} * page_size_, page);
}

/// Payload of a cell, with its overflow pages. Nothing if they are missing or more than the file has.
std::optional<Bytes> SqlitePages::payload(const Bytes& page, std::size_t at, std::uint64_t size) {
  const std::uint64_t usable = page_size_ - reserved_, most = usable - 35,
                      least = (usable - 12) * 32 / 255 - 23;
  if (size > std::min(kMostPayload, file_bytes_ + log_pages_.size() * page_size_)) return std::nullopt;
  std::uint64_t local = size;
  if (size > most) {
    const std::uint64_t fitting = least + (size - least) % (usable - 4);
    local = fitting <= most ? fitting : least;
  }
  if (at + local + (local < size ? 4 : 0) > page.size()) return std::nullopt;
  Bytes bytes(page.begin() + static_cast<std::ptrdiff_t>(at),
              page.begin() + static_cast<std::ptrdiff_t>(at + local));
  std::uint32_t next = local < size ? big32(&page[at + local]) : 0;
  Bytes overflow;
  while (bytes.size() < size) {
    if (next == 0 || overflow_left_ < page_size_ || !readPage(next, overflow)) return std::nullopt;
    overflow_left_ -= page_size_;
    const std::uint64_t part = std::min<std::uint64_t>(size - bytes.size(), usable - 4);
    bytes.insert(bytes.end(), overflow.begin() + 4, overflow.begin() + 4 + static_cast<std::ptrdiff_t>(part));
    next = big32(overflow.data());
  }
  return bytes;
}

std::optional<StoredRow> SqlitePages::rowAt(const Bytes& page, std::size_t at) {
  const auto size = varint(page, at), id = size ? varint(page, at) : std::nullopt;
  const auto bytes = id ? payload(page, at, *size) : std::nullopt;
  if (!bytes) return std::nullopt;
  std::size_t type_at = 0;
  const auto head = varint(*bytes, type_at);
  if (!head || *head > std::min<std::uint64_t>(bytes->size(), 9 * kMostValues)) return std::nullopt;
  StoredRow row{static_cast<std::int64_t>(*id), {}};
  std::size_t value_at = *head;
  while (type_at < *head) {
    const auto type = varint(*bytes, type_at);
    auto value = type ? valueAt(*bytes, value_at, *type) : std::nullopt;
    if (!value || row.values.size() == kMostValues) return std::nullopt;
    value_at += sizeOf(*type);
    row.values.push_back(std::move(*value));
  }
  return row;
}

bool SqlitePages::scanPage(const Bytes& page, PageCounts& counts,
                           const std::function<void(StoredRow&&)>& take, const base::Progress* progress) {
  ++counts.pages;
  if (page[0] != kTableLeaf) return true;
  const std::size_t cells = big16(&page[3]);
  std::set<std::size_t> begins;  // of the cells: each is one row
  for (std::size_t i = 0; i < cells && kLeafHeader + 2 * i + 2 <= page.size(); ++i) {
    if (progress && progress->cancelled()) return false;
    const std::size_t begin = big16(&page[kLeafHeader + 2 * i]);
    std::optional<StoredRow> row = begins.insert(begin).second ? rowAt(page, begin) : std::nullopt;
    if (!row)
      ++counts.unreadable;
    else
      take(std::move(*row));
  }
  return true;
}

PageCounts SqlitePages::scan(const std::function<void(StoredRow&&)>& row, const base::Progress* progress) {
  PageCounts counts;
  const std::uint64_t whole = file_bytes_ / page_size_;
  counts.missing = stated_pages_ > whole && log_pages_.empty() ? stated_pages_ - whole : 0;
  counts.missing_bytes = counts.missing * page_size_;
  // Each overflow page belongs to one row, in the file and in each transaction of the log. Pages that are
  // stated to belong to many rows are read a few times, but not as often as there are cells.
  overflow_left_ = kMostReads * (file_bytes_ + log_pages_.size() * page_size_);
  Bytes page(page_size_);
  for (std::uint64_t number = 1; number < whole; ++number)  // page 1, at 0, is the schema
    if (!read(file_, number * page_size_, page) || !scanPage(page, counts, row, progress)) return counts;
  for (const LogPage& logged : log_pages_)
    if (logged.number != 1 && read(log_, logged.offset, page) && !scanPage(page, counts, row, progress))
      return counts;
  return counts;
}

}  // namespace capstan::recording
