/// Where the tests find the checkout, what it was built into, and measured data.
#pragma once

#include <filesystem>
#include <string>

/// Skips a test of measured data, with the reason, if the data are absent. Use it first in the test.
#define REQUIRE_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is not on this machine"

namespace capstan::test {

/// A file of the checkout, by its path from the root; the root without one.
std::filesystem::path sourceFile(const std::string& name = {});

/// A file of resources/, by its path from there.
std::filesystem::path resourceFile(const std::string& name);

/// The command line program of this build, the window, and the stereo monitor.
std::string commandLineProgram();
std::string windowProgram();
std::string monitorProgram();
/// A simulated session that feeds stereo monitors (tests/support/monitor_session.cpp).
std::string monitorSession();

/// Folder of measured data: the environment variable CAPSTAN_DATA, or ../shared/data beside the checkout.
std::filesystem::path dataFolder();

/// A file beside the folder of measured data.
std::filesystem::path sharedFile(const std::string& name);

}  // namespace capstan::test
