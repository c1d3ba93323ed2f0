// The only file that is compiled with paths of this checkout: all others are the same in every checkout, so
// the compiler cache serves them.
#include "tests/support/folders.h"

#include <cstdlib>

namespace capstan::test {

namespace fs = std::filesystem;

fs::path sourceFile(const std::string& name) {
  return name.empty() ? fs::path(CAPSTAN_SOURCE_DIR) : fs::path(CAPSTAN_SOURCE_DIR) / name;
}

fs::path resourceFile(const std::string& name) { return sourceFile("resources") / name; }

std::string commandLineProgram() { return CAPSTAN_CLI; }

std::string windowProgram() { return CAPSTAN_WINDOW; }

std::string monitorProgram() { return CAPSTAN_MONITOR; }

std::string monitorSession() { return CAPSTAN_MONITOR_SESSION; }

fs::path dataFolder() {
  if (const char* given = std::getenv("CAPSTAN_DATA")) return given;
  return sourceFile().parent_path() / "shared" / "data";
}

fs::path sharedFile(const std::string& name) { return dataFolder().parent_path() / name; }

}  // namespace capstan::test
