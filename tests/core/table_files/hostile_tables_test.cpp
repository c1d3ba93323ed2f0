// Tables of strangers that are made to exhaust memory or time.
#include <gmock/gmock.h>
#include <zlib.h>

#include <csignal>

#include "core/table_files/expansion.h"
#include "core/table_files/hdf5_process.h"
#include "tests/core/table_files/sample_table.h"
#include "tests/support/folders.h"

namespace capstan::table_files {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// An element of a MATLAB file of version 5.
std::string element(std::uint32_t type, const std::string& data) {
  const auto size = static_cast<std::uint32_t>(data.size());
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &type, 4), std::memcpy(&bytes[4], &size, 4);
  return bytes + data + std::string((8 - data.size() % 8) % 8, '\0');
}

std::string numbers(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t value : values) bytes.append(reinterpret_cast<const char*>(&value), 4);
  return bytes;
}

std::string matlabHeader() {
  std::string header(128, ' ');
  header.replace(0, 6, "MATLAB");
  return header.replace(124, 4, std::string("\0\1IM", 4));
}

/// The variable t: a column of `rows` bytes of 0.
std::string column(std::uint32_t rows) {
  return element(14, element(6, numbers({6, 0})) + element(5, numbers({rows, 1})) + element(1, "t") +
                         element(1, std::string(rows, '\0')));
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
            bytes.size(), 9);
  packed.resize(size);
  const auto stated = static_cast<std::uint32_t>(size);
  return numbers({15, stated}) + packed;
}

TEST_F(TableFiles, ACompressedMatlabFileHasALimitOfExpansion) {
  write("bomb.mat", matlabHeader() + deflated(column(30'000'000)));
  EXPECT_LT(bytesOf("bomb.mat").size(), 40'000U);
  EXPECT_THAT(errorOf(path("bomb.mat")),
              AllOf(HasSubstr("t = 30000000 rows"), HasSubstr("more than 256 times its size")));
  write("small.mat", matlabHeader() + deflated(column(2'000'000)));  // 16 MB of doubles are read in any case
  EXPECT_EQ(errorOf(path("small.mat")), "");
}

TEST_F(TableFiles, MatlabDimensionsNeedTheirNumbers) {
  write("huge.mat",
        matlabHeader() + element(14, element(6, numbers({6, 0})) + element(5, numbers({1U << 31U, 1})) +
                                         element(1, "t") + element(9, std::string(8, '\0'))));
  EXPECT_THAT(errorOf(path("huge.mat")), HasSubstr("huge.mat"));
}

TEST_F(TableFiles, AMatlabFileHasALimitOfVariables) {  // each was opened three times
  write("many.mat", matlabHeader() + std::string(8 * 20'000, '\0'));
  EXPECT_THAT(errorOf(path("many.mat")), HasSubstr("is a damaged or incomplete MATLAB file"));
}

TEST_F(TableFiles, EmptyLinesOfCsvReserveNoMemory) {
  write("empty.csv", "t,a,b,c,d,e,f,g,h,i\n0,1,2,3,4,5,6,7,8,9\n" + std::string(1'000'000, '\n') +
                         "1,1,2,3,4,5,6,7,8,9\n");
  std::vector<double> t;
  EXPECT_THROW(columnsIn(path("empty.csv")).read([&](std::string_view name, std::size_t) {
    return name == "t" ? &t : nullptr;
  }),
               base::InputError);
  EXPECT_LT(t.capacity(), 200'000U);
}

TEST_F(TableFiles,
       IgnoredKeysOfJsonLinesCostNothingInLaterRows) {  // rows times keys steps would take an hour
  std::string text;
  for (int line = 0; line < 20; ++line) {
    text += "{\"t\": " + std::to_string(line);
    for (int key = 0; key < 4000; ++key) text += ",\"k" + std::to_string(4000 * line + key) + "\":0";
    text += "}\n";
  }
  for (int line = 20; line < 200'000; ++line) text += "{\"t\":" + std::to_string(line) + "}\n";
  write("keys.jsonl", text);
  std::vector<double> t;
  columnsIn(path("keys.jsonl")).read([&](std::string_view name, std::size_t) {
    return name == "t" ? &t : nullptr;
  });
  EXPECT_EQ(t.size(), 200'000U);
}

TEST_F(TableFiles, Hdf5FillsHaveALimitForAllColumns) {
  if (!hasPython()) GTEST_SKIP() << "needs python3-h5py and python3-scipy";
  ASSERT_TRUE(python(R"(with h5py.File('fill.h5', 'w') as f:
  for k in ('t', 'q_m1', 'q_m2'): f.create_dataset(k, shape=(1 << 20,), dtype='f8', chunks=(1 << 20,), fillvalue=1.0)
with h5py.File('link.h5', 'w') as f:
  f['trial/t'] = np.arange(3.0); f['t'] = h5py.ExternalLink('fill.h5', '/t')
)"));
  EXPECT_THAT(errorOf(path("fill.h5")), HasSubstr("more than 256 times its size"));
  EXPECT_EQ(readAll(path("link.h5")).at("t").size(), 3U) << "the link to another file was followed";
}

/// Ends as a reader of the file `table.h5` does that does `read`.
std::string errorOfProcess(const std::function<void(const ColumnTarget& target)>& read,
                           std::vector<double>& t) {
  try {
    readInProcess(
        "table.h5", [&](std::string_view, std::size_t) { return &t; }, read);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Hdf5Process, GivesColumnsAndErrors) {
  std::vector<double> t;
  EXPECT_EQ(errorOfProcess([](const ColumnTarget& target) { target("t", 0)->assign(200'000, 1.5); }, t), "");
  EXPECT_EQ(t, std::vector<double>(200'000, 1.5));
  EXPECT_EQ(errorOfProcess(
                [](const ColumnTarget&) {
                  throw base::InputError({"a.h5", 3, "t", "x", "is wrong", "Mend it"});
                },
                t),
            "a.h5:3: t = x: is wrong. Mend it");
  EXPECT_EQ(errorOfProcess([](const ColumnTarget&) {}, t), "");
}

TEST(Hdf5Process, ItsEndByASignalOrItsLimitsIsAnError) {
  std::vector<double> t;
  const std::string damaged =
      "table.h5: is damaged: HDF5 cannot read it. Restore it from a copy, or write it again";
  EXPECT_EQ(errorOfProcess([](const ColumnTarget& target) { target("t", 0), std::raise(SIGSEGV); }, t),
            damaged);
  EXPECT_EQ(errorOfProcess([](const ColumnTarget&) { std::abort(); }, t), damaged);
  EXPECT_EQ(
      errorOfProcess([](const ColumnTarget& target) { target("t", 0)->resize(std::size_t{1} << 30U); }, t),
      damaged);
}

TEST(Hdf5Process, AnErrorOfTheTargetIsThatOfTheCaller) {
  const ColumnTarget refusing = [](std::string_view name, std::size_t) -> std::vector<double>* {
    throw base::InputError({"table.h5", 0, std::string(name), {}, "is given twice", "Remove one"});
  };
  EXPECT_THROW(readInProcess("table.h5", refusing, [](const ColumnTarget& target) { target("t", 0); }),
               base::InputError);
}

TEST_F(TableFiles, ADamagedTableOfLinksEndsInAnError) {  // HDF5 1.10.8 frees memory that it never had
  EXPECT_THAT(errorOf(test::sourceFile("tests/fuzz/corpus/hdf5/crash-in-link-table.h5")),
              HasSubstr("crash-in-link-table.h5"));
}

}  // namespace
}  // namespace capstan::table_files
