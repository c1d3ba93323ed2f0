#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>

#include "core/base/error.h"
#include "core/table_files/hdf5_file.h"
#include "core/table_files/hdf5_read.h"
#include "core/table_files/matlab.h"

namespace capstan::table_files {
namespace {

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

constexpr std::size_t kLargestRatio = 1100;  ///< bytes by bytes of the file; deflate reaches 1032

[[noreturn]] void refuse(const std::string& file, const std::string& key, const std::string& value,
                         const std::string& reason, const std::string& remedy) {
  throw base::InputError({file, 0, key, value, reason, remedy});
}

[[noreturn]] void refuseFile(const std::string& file) {
  refuse(file, {}, {}, "cannot be read as a MATLAB file",
         "Save it in MATLAB by save('trial.mat', '-v7') or '-v7.3'");
}

/// Version in the header of the file: 5 or 7.3. Throws base::InputError for another file.
MatlabVersion versionOf(const std::string& file) {
  std::array<char, 128> header{};
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    refuse(file, {}, {}, "cannot be opened", "Check the path and its permissions");
  in.read(header.data(), header.size());
  const bool little = header[126] == 'I' && header[127] == 'M';
  const bool big = header[126] == 'M' && header[127] == 'I';
  if (in.gcount() != static_cast<std::streamsize>(header.size()) || (!little && !big)) refuseFile(file);
  const char major = little ? header[125] : header[124];
  if (major == 1) return MatlabVersion::k5;
  if (major == 2) return MatlabVersion::k73;
  refuseFile(file);
}

/// Number of rows of a variable. Throws base::InputError for another shape or type than a column.
std::size_t rowsOf(const matvar_t& variable, const std::string& file, std::size_t bytes) {
  const std::string name = variable.name;
  const bool numeric = variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64;
  if (!numeric || variable.isComplex)
    refuse(file, name, {}, "does not hold real numbers", "Save its values as doubles");
  if (variable.rank != 2 || !variable.dims || (variable.dims[0] != 1 && variable.dims[1] != 1))
    refuse(file, name,
           variable.rank == 2 && variable.dims ? fmt::format("{} × {}", variable.dims[0], variable.dims[1])
                                               : fmt::format("{} dimensions", variable.rank),
           "is no column", "Save one vector for each column");
  const std::size_t rows = std::max(variable.dims[0], variable.dims[1]);
  if (std::min(variable.dims[0], variable.dims[1]) == 0 || rows == 0)
    refuse(file, name, {}, "has no rows", "Add at least one row of values");
  if (rows > kLargestRatio * bytes)
    refuse(file, name, fmt::format("{} rows", rows),
           fmt::format("has more rows than the file's {} bytes can hold", bytes),
           "Save the file again: it is damaged or not complete");
  return rows;
}

template <class T>
void append(const matvar_t& variable, std::size_t rows, std::vector<double>& values) {
  const T* data = static_cast<const T*>(variable.data);
  values.assign(data, data + rows);
}

/// The numbers of a variable that was read.
void valuesOf(const matvar_t& variable, std::size_t rows, std::vector<double>& values) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return append<double>(variable, rows, values);
    case MAT_C_SINGLE:
      return append<float>(variable, rows, values);
    case MAT_C_INT8:
      return append<std::int8_t>(variable, rows, values);
    case MAT_C_UINT8:
      return append<std::uint8_t>(variable, rows, values);
    case MAT_C_INT16:
      return append<std::int16_t>(variable, rows, values);
    case MAT_C_UINT16:
      return append<std::uint16_t>(variable, rows, values);
    case MAT_C_INT32:
      return append<std::int32_t>(variable, rows, values);
    case MAT_C_UINT32:
      return append<std::uint32_t>(variable, rows, values);
    case MAT_C_INT64:
      return append<std::int64_t>(variable, rows, values);
    default:
      return append<std::uint64_t>(variable, rows, values);
  }
}

/// Reads the columns among variables, which have no data yet.
class ColumnReader {
 public:
  ColumnReader(mat_t* mat, std::string file, const ColumnTarget& target)
      : mat_(mat), file_(std::move(file)), bytes_(std::filesystem::file_size(file_)), target_(target) {}

  void read(matvar_t& variable) {
    std::vector<double>* values = target_(variable.name, index_++);
    if (!values) return;
    const std::string name = variable.name;
    const std::size_t rows = rowsOf(variable, file_, bytes_);
    if (!first_) first_.emplace(name, rows);
    if (rows != first_->second)
      refuse(file_, name, fmt::format("{} rows", rows),
             fmt::format("does not have the {} rows of {}", first_->second, first_->first),
             "Give all columns the same number of rows, and NaN where there is no value");
    if (Mat_VarReadDataAll(mat_, &variable) != 0 || !variable.data ||
        variable.nbytes < rows * Mat_SizeOfClass(variable.class_type))
      refuse(file_, name, {}, "cannot be read", "Save the file again: it is damaged or not complete");
    valuesOf(variable, rows, *values);
    const auto infinite =
        std::find_if(values->begin(), values->end(), [](double x) { return std::isinf(x); });
    if (infinite != values->end())
      refuse(file_, fmt::format("{}, row {}", name, infinite - values->begin() + 1),
             fmt::format("{}", *infinite), "is not a finite number",
             "Save a finite number, or NaN where there is no value");
  }

 private:
  mat_t* mat_;
  std::string file_;
  std::size_t bytes_;
  const ColumnTarget& target_;
  std::size_t index_ = 0;
  std::optional<std::pair<std::string, std::size_t>> first_;
};

/// The variables of the file, without their data.
std::vector<Variable> variablesOf(mat_t* mat) {
  std::vector<Variable> all;
  while (Variable next{Mat_VarReadNextInfo(mat)})
    if (next->name) all.push_back(std::move(next));
  return all;
}

bool isTime(const Variable& variable) { return std::string_view(variable->name) == "t"; }
bool isStructure(const Variable& variable) {
  return variable->class_type == MAT_C_STRUCT && variable->rank == 2 && variable->dims &&
         variable->dims[0] == 1 && variable->dims[1] == 1;
}

}  // namespace

void readMatlab(const std::filesystem::path& path, const ColumnTarget& target) {
  if (versionOf(path.string()) == MatlabVersion::k73) return readHdf5(path, target);
  const Hdf5Lock lock;
  const File mat(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!mat) refuseFile(path.string());
  const std::vector<Variable> variables = variablesOf(mat.get());
  ColumnReader reader(mat.get(), path.string(), target);
  const auto structure = std::find_if(variables.begin(), variables.end(), isStructure);
  const bool only =
      structure != variables.end() && std::count_if(variables.begin(), variables.end(), isStructure) == 1;
  if (std::any_of(variables.begin(), variables.end(), isTime) || !only) {
    for (const Variable& variable : variables) reader.read(*variable);
    return;
  }
  const auto fields = static_cast<std::size_t>(Mat_VarGetNumberOfFields(structure->get()));
  for (std::size_t i = 0; i < fields; ++i) {
    matvar_t* field = Mat_VarGetStructFieldByIndex(structure->get(), i, 0);
    if (field && field->name) reader.read(*field);
  }
}

}  // namespace capstan::table_files
