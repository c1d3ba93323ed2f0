#include "core/base/resource.h"

#include <cstdlib>
#include <vector>

#include "core/base/error.h"

namespace capstan::base {

std::filesystem::path resource(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> roots;
  if (const char* given = std::getenv("CAPSTAN_RESOURCES")) roots.emplace_back(given);
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (!program.empty()) roots.push_back(program.parent_path().parent_path() / "share" / "capstan");
  roots.emplace_back(CAPSTAN_RESOURCES);
  for (const auto& root : roots)
    if (std::filesystem::exists(root / file, ignored)) return root / file;
  throw InputError({file.string(),
                    0,
                    {},
                    {},
                    "is not in any resource folder",
                    "Set CAPSTAN_RESOURCES to the resources folder of Capstan"});
}

}  // namespace capstan::base
