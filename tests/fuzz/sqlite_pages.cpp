#include "core/recording/sqlite_pages.h"

#include "core/recording/schema.h"
#include "tests/fuzz/fuzz_target.h"

/// The reader of database pages alone, faster than all of the recovery.
CAPSTAN_FUZZ_TARGET(sqlite_pages) {
  using namespace capstan;
  fuzz::emptyFolder();
  const auto parts = fuzz::partsOf(bytes, 2);
  const std::filesystem::path file = fuzz::fileOf(parts[0], "pages.capstan");
  if (!parts[1].empty()) fuzz::fileOf(parts[1], "pages.capstan-wal");
  fuzz::allowInputError([&] {
    recording::SqlitePages pages(file, recording::kPageSize);
    pages.scan(
        [](recording::StoredRow&& row) { fuzz::require(row.values.size() <= 64, "a row has few values"); },
        nullptr);
  });
}
