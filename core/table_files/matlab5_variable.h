#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/table_files/matlab5_bytes.h"

/// Variables of MATLAB files of version 5, for core/table_files only.
namespace capstan::table_files {

/// Data types of elements.
enum MatlabType : std::uint32_t {
  kMiInt8 = 1,
  kMiUint8 = 2,
  kMiInt16 = 3,
  kMiUint16 = 4,
  kMiInt32 = 5,
  kMiUint32 = 6,
  kMiSingle = 7,
  kMiDouble = 9,
  kMiInt64 = 12,
  kMiUint64 = 13,
  kMiMatrix = 14,
  kMiCompressed = 15
};

/// Classes of arrays.
enum MatlabClass : unsigned { kMxStructure = 2, kMxDouble = 6, kMxUint64 = 15 };

/// Beginning of an element: what follows it.
struct MatlabTag {
  std::uint32_t type = 0;
  std::uint32_t size = 0;     ///< of the data [bytes]
  std::uint32_t padding = 0;  ///< after them [bytes]
};

/// An array's description, which precedes its data.
struct MatlabVariable {
  std::string name;
  unsigned array_class = 0;
  bool complex = false;
  std::vector<std::uint32_t> dims;
  std::uint64_t end = 0;  ///< position of the first byte after it

  bool isNumeric() const { return array_class >= kMxDouble && array_class <= kMxUint64; }
  bool isSingleStructure() const {
    return array_class == kMxStructure && dims.size() == 2 && dims[0] == 1 && dims[1] == 1;
  }
};

/// Reads elements of one file. All functions throw base::InputError for a damaged file.
class MatlabReader {
 public:
  MatlabReader(MatlabBytes& bytes, std::string file, bool swap)
      : bytes_(bytes), file_(std::move(file)), swap_(swap) {}

  MatlabTag tag();
  /// Reads the description of an array, behind its tag, whose size is `size`.
  MatlabVariable variable(std::uint64_t size);
  /// Reads `count` numbers of an array and converts them to double.
  void numbers(std::size_t count, std::vector<double>& values);
  /// Reads the names of the fields of a structure, behind its description.
  std::vector<std::string> fieldNames();
  /// Skips what remains of an array.
  void leave(const MatlabVariable& variable);

 private:
  template <class T>
  T number();
  template <class T>
  void append(std::size_t count, std::vector<double>& values);
  std::string text(std::uint32_t longest);
  [[noreturn]] void damaged() const { refuseDamagedMatlab(file_); }

  MatlabBytes& bytes_;
  std::string file_;
  bool swap_;
};

}  // namespace capstan::table_files
