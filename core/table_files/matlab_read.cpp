#include <array>
#include <fstream>

#include "core/base/error.h"
#include "core/table_files/hdf5_read.h"
#include "core/table_files/matlab.h"
#include "core/table_files/matlab5_read.h"

namespace capstan::table_files {
namespace {

/// Version in the header of the file. Throws base::InputError for another file.
MatlabVersion versionOf(const std::string& file) {
  std::array<char, 128> header{};
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file))
    throw base::InputError({file, 0, {}, {}, "cannot be opened", "Check the path and its permissions"});
  in.read(header.data(), header.size());
  const bool little = header[126] == 'I' && header[127] == 'M';
  const bool big = header[126] == 'M' && header[127] == 'I';
  const char major = little ? header[125] : header[124];
  if (in.gcount() != static_cast<std::streamsize>(header.size()) || (!little && !big) || major < 1 ||
      major > 2)
    throw base::InputError({file,
                            0,
                            {},
                            {},
                            "is no MATLAB file of version 5 or 7.3",
                            "Save it in MATLAB by save('trial.mat', '-v7') or '-v7.3'"});
  return major == 1 ? MatlabVersion::k5 : MatlabVersion::k73;
}

}  // namespace

void readMatlab(const std::filesystem::path& path, const ColumnTarget& target) {
  if (versionOf(path.string()) == MatlabVersion::k73) return readHdf5(path, target);
  readMatlab5(path, target);
}

}  // namespace capstan::table_files
