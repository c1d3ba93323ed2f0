#pragma once

#include <cstdlib>
#include <filesystem>

/// Skips a test of measured data, with the reason, if the data are absent. Use it first in the test.
#define REQUIRE_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is not on this machine"

namespace capstan::test {

/// Folder of measured data: the environment variable CAPSTAN_DATA, or ../shared/data beside the checkout.
inline std::filesystem::path dataFolder() {
  const char* given = std::getenv("CAPSTAN_DATA");
  return given ? std::filesystem::path(given)
               : std::filesystem::path(CAPSTAN_SOURCE_DIR).parent_path() / "shared" / "data";
}

}  // namespace capstan::test
