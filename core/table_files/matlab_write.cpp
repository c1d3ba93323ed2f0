#include <fmt/format.h>
#include <matio.h>

#include <array>
#include <memory>

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/base/software.h"
#include "core/table_files/hdf5_file.h"
#include "core/table_files/matlab.h"

namespace capstan::table_files {
namespace {

constexpr std::size_t kMostRows = ((std::size_t{1} << 31) - 64) / sizeof(double);  ///< of version 5

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw base::InputError(
      {path.string(), 0, {}, {}, "cannot be written", "Check the folder, its permissions and the space"});
}

void write(mat_t* file, const NamedColumn& column, const std::filesystem::path& path) {
  std::array<std::size_t, 2> dims = {column.values->size(), 1};
  auto* const values = const_cast<double*>(column.values->data());  // not written to: MAT_F_DONT_COPY_DATA
  const std::unique_ptr<matvar_t, void (*)(matvar_t*)> variable(
      Mat_VarCreate(column.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims.data(), values,
                    MAT_F_DONT_COPY_DATA),
      Mat_VarFree);
  if (!variable || Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_ZLIB) != 0) fail(path);
}

}  // namespace

void writeMatlab(const std::filesystem::path& path, std::span<const NamedColumn> columns,
                 MatlabVersion version) {
  for (const NamedColumn& column : columns)
    if (version == MatlabVersion::k5 && column.values->size() > kMostRows)
      throw base::InputError({path.string(), 0, column.name, fmt::format("{} rows", column.values->size()),
                              "has too many rows for a MATLAB file of version 5", "Write version 7.3"});
  base::PartFile part(path);
  {
    const Hdf5Lock lock;
    const std::string header = fmt::format("MATLAB {} MAT-file, measured table, written by Capstan {}",
                                           version == MatlabVersion::k5 ? "5.0" : "7.3", base::version());
    const std::unique_ptr<mat_t, int (*)(mat_t*)> file(
        Mat_CreateVer(part.path().c_str(), header.c_str(),
                      version == MatlabVersion::k5 ? MAT_FT_MAT5 : MAT_FT_MAT73),
        Mat_Close);
    if (!file) fail(path);
    for (const NamedColumn& column : columns) write(file.get(), column, path);
  }
  part.commit();
}

}  // namespace capstan::table_files
