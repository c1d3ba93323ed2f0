#include <cmath>
#include <cstring>

#include "core/table_files/table_kind.h"
#include "tests/core/table_files/sample_table.h"

namespace capstan::table_files {
namespace {

/// Equal to the last bit; every NaN equals every other.
void expectSameBits(const Columns& back, const Columns& columns) {
  ASSERT_EQ(back.size(), columns.size());
  for (const auto& [name, values] : columns) {
    const std::vector<double>& read = back.at(name);
    ASSERT_EQ(read.size(), values.size()) << name;
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_TRUE(std::isnan(values[i]) ? std::isnan(read[i])
                                        : std::memcmp(&read[i], &values[i], sizeof(double)) == 0)
          << name << " row " << i << ": " << read[i] << ", not " << values[i];
  }
}

TEST_F(TableFiles, EveryKindGivesTheBitsBack) {
  for (const TableKindFacts& kind : tableKinds())
    for (const std::string_view suffix : kind.suffixes)
      for (const MatlabVersion version : {MatlabVersion::k5, MatlabVersion::k73}) {
        SCOPED_TRACE(suffix);
        const std::string name = "a" + std::string(suffix);
        writeAll(name, hardNumbers(), version);
        expectSameBits(readAll(path(name)), hardNumbers());
        std::filesystem::copy_file(path(name), path("a.bin"),
                                   std::filesystem::copy_options::overwrite_existing);
        expectSameBits(readAll(path("a.bin")), hardNumbers());  // known by its first bytes
      }
}

TEST_F(TableFiles, MoreRowsThanAPieceAreWhole) {
  Columns columns;
  for (int i = 0; i < 200'000; ++i) {
    columns["t"].push_back(1e-3 * i);
    columns["q1"].push_back(std::sin(i));
  }
  for (const char* name : {"a.jsonl", "a.h5", "a.mat"}) {
    writeAll(name, columns);
    expectSameBits(readAll(path(name)), columns);
    EXPECT_EQ(columnNames(path(name)).size(), std::string("t,q1").size()) << columnNames(path(name));
  }
}

}  // namespace
}  // namespace capstan::table_files
