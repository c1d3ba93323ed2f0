#include "core/table_files/read_columns.h"
#include "tests/fuzz/table_laws.h"

CAPSTAN_FUZZ_TARGET(json_lines) {
  using namespace capstan;
  const std::filesystem::path file = fuzz::fileOf(bytes, "table.jsonl");
  fuzz::allowInputError([&] { table_files::columnNames(file); });
  fuzz::allowInputError([&] { fuzz::requireTable(recording::readMeasuredTable(file)); });
}
