/// A table, its files in a folder of their own, and what is read back.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/table_files/read_columns.h"
#include "core/table_files/write_columns.h"

namespace capstan::table_files {

using Columns = std::map<std::string, std::vector<double>>;

inline Columns readAll(const std::filesystem::path& path) {
  Columns columns;
  columnsIn(path).read([&](std::string_view name, std::size_t) { return &columns[std::string(name)]; });
  return columns;
}

/// what() of the error that reading `path` ends with; empty: none.
inline std::string errorOf(const std::filesystem::path& path) {
  try {
    readAll(path);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

class TableFiles : public ::testing::Test {
 protected:
  TableFiles()
      : folder_(std::filesystem::temp_directory_path() / ("capstan_tables_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~TableFiles() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  std::string bytesOf(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Runs Python code with h5py as `h5py`, numpy as `np`, scipy.io as `sio`, in the folder. False: it failed.
  bool python(const std::string& code) const {
    write("run.py", "import h5py, numpy as np, scipy.io as sio\n" + code);
    return std::system(("cd " + folder_.string() + " && /usr/bin/python3 run.py").c_str()) == 0;
  }
  static bool hasPython() {
    return std::system("/usr/bin/python3 -c 'import h5py, scipy.io' 2>/dev/null") == 0;
  }
  /// Writes `columns` as `name`.
  void writeAll(const std::string& name, const Columns& columns,
                MatlabVersion version = MatlabVersion::k5) const {
    std::vector<NamedColumn> named;
    for (const auto& [key, values] : columns) named.push_back({key, "rad", "sample", &values});
    writeColumns(path(name), named, {{"robot", "a robot"}}, version);
  }

  std::filesystem::path folder_;
};

/// Numbers whose bits a format may lose, with values that are missing.
inline Columns hardNumbers() {
  using Limits = std::numeric_limits<double>;
  const double none = Limits::quiet_NaN();
  return {{"t", {0.0, 0.1, 1.0 / 3.0, 1e15 + 0.125, 2e16}},
          {"q_m1", {-0.0, Limits::denorm_min(), Limits::max(), Limits::lowest(), Limits::epsilon()}},
          {"p_c1", {none, 0.07, none, none, -1e-300}}};
}

}  // namespace capstan::table_files
