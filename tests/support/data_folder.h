#pragma once

#include <cstdlib>
#include <filesystem>

/// First in a test of measured data: skips it, with the reason, where they are absent.
#define REQUIRE_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is not on this machine"

namespace capstan::test {

/// The folder of measured data: what CAPSTAN_DATA names, or ../shared/data beside the checkout.
inline std::filesystem::path dataFolder() {
  const char* given = std::getenv("CAPSTAN_DATA");
  return given ? std::filesystem::path(given)
               : std::filesystem::path(CAPSTAN_SOURCE_DIR).parent_path() / "shared" / "data";
}

}  // namespace capstan::test
