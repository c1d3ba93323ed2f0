#include "core/table_files/matlab5_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.h"
#include "core/table_files/expansion.h"
#include "core/table_files/matlab5_variable.h"

namespace capstan::table_files {
namespace {

constexpr std::uint64_t kHeader = 128;
constexpr std::uint64_t kTag = 8;
constexpr std::size_t kMostElements = 10'000;  ///< variables of a file; more is damage

/// A top-level element of the file.
struct Element {
  MatlabTag tag;
  std::uint64_t begin = 0;  ///< of its data in the file
};

/// The elements of a file.
class ElementList {
 public:
  explicit ElementList(const std::string& file) : file_(file) {
    const std::uint64_t size = std::filesystem::file_size(file);
    std::array<char, 2> mark{};
    FileBytes header(file, 126, 2);
    header.read(mark.data(), mark.size());
    swap_ = mark[0] == 'M';
    for (std::uint64_t at = kHeader; at + kTag <= size;) {
      FileBytes bytes(file, at, kTag);
      const MatlabTag tag = MatlabReader(bytes, file, swap_).tag();
      if (tag.size > size - at - kTag || elements_.size() == kMostElements) refuseDamagedMatlab(file);
      elements_.push_back({tag, at + kTag});
      at += kTag + tag.size + tag.padding;
    }
  }

  /// Calls `work` with a reader and the description of each array, behind which the reader is.
  template <class Work>
  void forEach(Work&& work) const {
    for (const Element& element : elements_) {
      FileBytes bytes(file_, element.begin, element.tag.size);
      if (element.tag.type == kMiMatrix) {
        MatlabReader reader(bytes, file_, swap_);
        work(reader, reader.variable(element.tag.size));
      } else if (element.tag.type == kMiCompressed) {
        InflatedBytes inflated(std::move(bytes));
        MatlabReader reader(inflated, file_, swap_);
        const MatlabTag tag = reader.tag();
        if (tag.type == kMiMatrix) work(reader, reader.variable(tag.size));
      }
    }
  }

 private:
  std::string file_;
  bool swap_ = false;
  std::vector<Element> elements_;
};

/// Gives the columns of a file to their target.
class ColumnTaker {
 public:
  ColumnTaker(std::string file, const ColumnTarget& target) : file_(std::move(file)), target_(target) {}

  void take(MatlabReader& reader, const MatlabVariable& variable, const std::string& name) {
    std::vector<double>* values = target_(name, index_++);
    if (!values) return;
    const std::size_t rows = rowsOf(variable, name);
    if (!first_) first_.emplace(name, rows);
    if (rows != first_->second)
      refuse(name, fmt::format("{} rows", rows),
             fmt::format("does not have the {} rows of {}", first_->second, first_->first),
             "Give all columns the same number of rows, and NaN where there is no value");
    bytes_ += rows * sizeof(double);
    if (bytes_ > mostColumnBytes(std::filesystem::file_size(file_)))
      refuse(name, fmt::format("{} rows", rows),
             fmt::format("expands the file to more than {} times its size", kLargestExpansion),
             "Check the values of its columns: hardly any differ");
    values->clear();
    reader.numbers(rows, *values);
    const auto found = std::find_if(values->begin(), values->end(), [](double x) { return std::isinf(x); });
    if (found != values->end())
      refuse(fmt::format("{}, row {}", name, found - values->begin() + 1), fmt::format("{}", *found),
             "is not a finite number", "Save a finite number, or NaN where there is no value");
  }

 private:
  /// Number of rows of a variable. Throws base::InputError for another shape or type than a column.
  std::size_t rowsOf(const MatlabVariable& variable, const std::string& name) const {
    if (!variable.isNumeric() || variable.complex)
      refuse(name, {}, "does not hold real numbers", "Save its values as doubles");
    const std::vector<std::uint32_t>& dims = variable.dims;
    if (dims.size() != 2 || (dims[0] != 1 && dims[1] != 1 && dims[0] != 0 && dims[1] != 0))
      refuse(name,
             dims.size() == 2 ? fmt::format("{} × {}", dims[0], dims[1])
                              : fmt::format("{} dimensions", dims.size()),
             "is no column", "Save one vector for each column");
    if (dims[0] == 0 || dims[1] == 0) refuse(name, {}, "has no rows", "Add at least one row of values");
    return std::max(dims[0], dims[1]);
  }
  [[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& reason,
                           const std::string& remedy) const {
    throw base::InputError({file_, 0, key, value, reason, remedy});
  }

  std::string file_;
  const ColumnTarget& target_;
  std::size_t index_ = 0;
  std::uint64_t bytes_ = 0;  ///< of all columns
  std::optional<std::pair<std::string, std::size_t>> first_;
};

void takeFields(MatlabReader& reader, ColumnTaker& taker, const std::string& file) {
  for (const std::string& name : reader.fieldNames()) {
    const MatlabTag tag = reader.tag();
    if (tag.type != kMiMatrix) refuseDamagedMatlab(file);
    const MatlabVariable field = reader.variable(tag.size);
    taker.take(reader, field, name);
    reader.leave(field);
  }
}

}  // namespace

void readMatlab5(const std::filesystem::path& path, const ColumnTarget& target) {
  const std::string file = path.string();
  const ElementList elements(file);
  bool has_time = false;
  int structures = 0;
  elements.forEach([&](MatlabReader&, const MatlabVariable& variable) {
    has_time = has_time || variable.name == "t";
    structures += variable.isSingleStructure() ? 1 : 0;
  });
  ColumnTaker taker(file, target);
  elements.forEach([&](MatlabReader& reader, const MatlabVariable& variable) {
    if (has_time || structures != 1)
      taker.take(reader, variable, variable.name);
    else if (variable.isSingleStructure())
      takeFields(reader, taker, file);
  });
}

}  // namespace capstan::table_files
