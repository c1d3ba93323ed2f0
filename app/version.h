#pragma once

#include <ceres/version.h>
#include <fmt/core.h>
#include <sqlite3.h>

#include <Eigen/Core>
#include <opencv2/core/utility.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/base/software.h"

namespace capstan {

/// Names and versions of libraries.
using LibraryVersions = std::vector<std::pair<std::string, std::string>>;

/// Libraries of core/: OpenCV and SQLite as loaded, Eigen and Ceres as compiled.
inline LibraryVersions coreLibraries() {
  return {{"OpenCV", cv::getVersionString()},
          {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"Ceres", CERES_VERSION_STRING},
          {"SQLite", sqlite3_libversion()}};
}

/// Text of --version: name and version of the program with the commit, then a line for each library.
inline std::string versionText(const std::string& program, const LibraryVersions& libraries) {
  std::string text = base::software(program);
  for (const auto& [name, version] : libraries) text += fmt::format("\n{:<12}{}", name, version);
  return text;
}

}  // namespace capstan
