#include "core/table_files/hdf5_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/table_files/expansion.h"
#include "core/table_files/hdf5_file.h"
#include "core/table_files/hdf5_process.h"

namespace capstan::table_files {
namespace {

constexpr hsize_t kPiece = 1U << 16;             ///< rows that are read at once
constexpr hsize_t kLargestChunk = 64U << 20;     ///< bytes of a chunk, which HDF5 reads as a whole
constexpr hsize_t kMostRows = hsize_t{1} << 31;  ///< 25 days at 1 kHz
constexpr hsize_t kLargestRatio = 1100;          ///< bytes by bytes stored; deflate reaches 1032
constexpr std::size_t kLargestNumber = 16;       ///< bytes of a number; others are damaged
constexpr hsize_t kUnstored = 16U << 20;         ///< bytes that may be fill values, which are not stored

/// An open data set and what errors name it.
struct DataSet {
  std::string file, name;
  Hdf5Id id;
  hsize_t file_size = 0;  ///< [bytes]

  [[noreturn]] void refuse(const std::string& value, const std::string& reason,
                           const std::string& remedy) const {
    throw base::InputError({file, 0, name, value, reason, remedy});
  }
};

std::string textOf(const std::array<hsize_t, 2>& dims, int rank) {
  return rank == 1 ? fmt::format("{}", dims[0]) : fmt::format("{} × {}", dims[0], dims[1]);
}

/// Number of rows. Throws base::InputError for another shape than a column.
hsize_t rowsOf(const DataSet& set) {
  if (H5Aexists(set.id.get(), "MATLAB_empty") > 0) return 0;  // whose dimensions are the data
  const Hdf5Id space(H5Dget_space(set.id.get()), H5Sclose);
  const int rank = space.isOpen() ? H5Sget_simple_extent_ndims(space.get()) : -1;
  std::array<hsize_t, 2> dims = {1, 1};
  if (rank < 1 || rank > 2)
    set.refuse(fmt::format("{} dimensions", std::max(rank, 0)), "is no column",
               "Give each column a data set with one dimension");
  H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr);
  if (rank == 2 && dims[0] != 1 && dims[1] != 1)
    set.refuse(textOf(dims, rank), "is no column", "Give each column a data set with one dimension");
  const hsize_t rows = rank == 1 ? dims[0] : std::max(dims[0], dims[1]);
  if (rank == 2 && std::min(dims[0], dims[1]) == 0) return 0;
  if (rows > kMostRows)
    set.refuse(textOf(dims, rank), fmt::format("has more than {} rows", kMostRows), "Divide the recording");
  return rows;
}

/// Throws base::InputError for values that are no numbers.
void checkType(const DataSet& set) {
  const Hdf5Id type(H5Dget_type(set.id.get()), H5Tclose);
  const H5T_class_t kind = type.isOpen() ? H5Tget_class(type.get()) : H5T_NO_CLASS;
  const std::size_t size = type.isOpen() ? H5Tget_size(type.get()) : 0;
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || size > kLargestNumber)
    set.refuse({}, "does not hold numbers", "Store its values as 64-bit floating-point numbers");
}

/// Throws base::InputError for data outside this file, chunks too large to read, and more data than the file
/// can hold.
void checkStorage(const DataSet& set, hsize_t rows) {
  const Hdf5Id made(H5Dget_create_plist(set.id.get()), H5Pclose);
  const H5D_layout_t layout = made.isOpen() ? H5Pget_layout(made.get()) : H5D_LAYOUT_ERROR;
  if (layout == H5D_VIRTUAL || (layout == H5D_CONTIGUOUS && H5Pget_external_count(made.get()) != 0))
    set.refuse({}, "is stored in another file", "Write its values into this file");
  for (int i = 0; made.isOpen() && i < H5Pget_nfilters(made.get()); ++i) {
    unsigned flags = 0, config = 0;
    std::size_t parameters = 0;
    const H5Z_filter_t filter = H5Pget_filter2(made.get(), static_cast<unsigned>(i), &flags, &parameters,
                                               nullptr, 0, nullptr, &config);
    if (filter < 0 || H5Zfilter_avail(filter) <= 0)
      set.refuse(fmt::format("filter {}", filter), "is compressed in a way that HDF5 itself does not know",
                 "Write it with gzip, or uncompressed");
  }
  const Hdf5Id type(H5Dget_type(set.id.get()), H5Tclose);
  const hsize_t size = H5Tget_size(type.get());
  if (layout == H5D_CHUNKED) {
    std::array<hsize_t, 2> chunk = {1, 1};
    H5Pget_chunk(made.get(), 2, chunk.data());
    if (chunk[0] > kLargestChunk || chunk[1] > kLargestChunk || chunk[0] * chunk[1] * size > kLargestChunk)
      set.refuse({}, fmt::format("has chunks of more than {} MiB", kLargestChunk >> 20U),
                 "Write it with smaller chunks, for example of 16,384 values");
  }
  // A chunk that is not stored holds the fill value; all other layouts are stored as they are.
  const hsize_t stored = std::min<hsize_t>(H5Dget_storage_size(set.id.get()), set.file_size);
  const hsize_t most = layout == H5D_CHUNKED ? std::max(kUnstored, kLargestRatio * stored) : stored;
  if (rows * size > most)
    set.refuse(fmt::format("{} rows", rows), fmt::format("has more rows than its {} bytes can hold", stored),
               "Write the file again: it is damaged or not complete");
}

/// Appends all rows to `values`.
void readRows(const DataSet& set, hsize_t rows, std::vector<double>& values) {
  const Hdf5Id space(H5Dget_space(set.id.get()), H5Sclose);
  std::array<hsize_t, 2> dims = {1, 1}, begin = {0, 0}, count = {1, 1};
  H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr);
  const std::size_t along = dims[0] == rows ? 0 : 1;
  values.resize(rows);
  for (hsize_t row = 0; row < rows; row += kPiece) {
    const hsize_t piece = std::min(kPiece, rows - row);
    begin[along] = row, count[along] = piece;
    const Hdf5Id memory(H5Screate_simple(1, &piece, nullptr), H5Sclose);
    if (H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dread(set.id.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, &values[row]) < 0)
      set.refuse({}, fmt::format("cannot be read from row {} on", row + 1),
                 "The file is damaged: write it again");
  }
}

void checkFinite(const DataSet& set, const std::vector<double>& values) {
  const auto found = std::find_if(values.begin(), values.end(), [](double x) { return std::isinf(x); });
  if (found == values.end()) return;
  throw base::InputError({set.file, 0, fmt::format("{}, row {}", set.name, found - values.begin() + 1),
                          fmt::format("{}", *found), "is not a finite number",
                          "Write a finite number, or NaN where there is no value"});
}

/// The names of the hard links in a group, in alphabetical order.
std::vector<std::string> namesIn(const Hdf5Id& group) {
  std::vector<std::string> names;
  H5G_info_t facts{};
  if (H5Gget_info(group.get(), &facts) < 0) return names;
  for (hsize_t i = 0; i < facts.nlinks; ++i) {
    std::array<char, 256> name{};  // longer names belong to no column
    H5L_info_t link{};
    if (H5Lget_name_by_idx(group.get(), ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(),
                           H5P_DEFAULT) < 0)
      break;
    if (H5Lget_info(group.get(), name.data(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD)
      names.emplace_back(name.data());
  }
  return names;
}

/// The object `name` of a group if it has the type `type`.
Hdf5Id objectIn(const Hdf5Id& group, const std::string& name, H5I_type_t type) {
  Hdf5Id object(H5Oopen(group.get(), name.c_str(), H5P_DEFAULT), H5Oclose);
  return object.isOpen() && H5Iget_type(object.get()) == type ? std::move(object) : Hdf5Id();
}

bool hasTime(const Hdf5Id& group) {
  H5L_info_t link{};
  return H5Lexists(group.get(), "t", H5P_DEFAULT) > 0 &&
         H5Lget_info(group.get(), "t", &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD &&
         objectIn(group, "t", H5I_DATASET).isOpen();
}

/// The only group below `root` that has a data set `t`; nothing if none or several have.
Hdf5Id onlyTableIn(const Hdf5Id& root) {
  Hdf5Id table;
  for (const std::string& name : namesIn(root)) {
    Hdf5Id group = objectIn(root, name, H5I_GROUP);
    if (!group.isOpen() || !hasTime(group)) continue;
    if (table.isOpen()) return {};
    table = std::move(group);
  }
  return table;
}

void readGroup(const Hdf5Id& group, const std::string& file, const ColumnTarget& target) {
  std::optional<std::pair<std::string, hsize_t>> first;
  std::size_t index = 0;
  hsize_t bytes = 0;  // of all columns
  const hsize_t file_size = std::filesystem::file_size(file);
  for (const std::string& name : namesIn(group)) {
    DataSet set{file, name, objectIn(group, name, H5I_DATASET), file_size};
    std::vector<double>* values = set.id.isOpen() ? target(name, index++) : nullptr;
    if (!values) continue;
    checkType(set);
    const hsize_t rows = rowsOf(set);
    if (!first) first.emplace(name, rows);
    if (rows != first->second)
      set.refuse(fmt::format("{} rows", rows),
                 fmt::format("does not have the {} rows of {}", first->second, first->first),
                 "Give all columns the same number of rows, and NaN where there is no value");
    if (rows == 0) set.refuse({}, "has no rows", "Add at least one row of values");
    checkStorage(set, rows);
    bytes += rows * sizeof(double);
    if (bytes > mostColumnBytes(file_size))
      set.refuse(fmt::format("{} rows", rows),
                 fmt::format("expands the file to more than {} times its size", kLargestExpansion),
                 "Check the values of its columns: hardly any differ");
    readRows(set, rows, *values);
    checkFinite(set, *values);
  }
}

void readHere(const std::filesystem::path& path, const ColumnTarget& target) {
  const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Hdf5Id root(file.isOpen() ? H5Gopen2(file.get(), "/", H5P_DEFAULT) : -1, H5Gclose);
  if (!root.isOpen())
    throw base::InputError({path.string(),
                            0,
                            {},
                            {},
                            "cannot be read as an HDF5 file",
                            "Check that it is one, complete, and closed by the program that writes it"});
  const Hdf5Id table = hasTime(root) ? Hdf5Id() : onlyTableIn(root);
  readGroup(table.isOpen() ? table : root, path.string(), target);
}

}  // namespace

void readHdf5(const std::filesystem::path& path, const ColumnTarget& target) {
  readInProcess(path, target, [&](const ColumnTarget& taker) { readHere(path, taker); });
}

}  // namespace capstan::table_files
