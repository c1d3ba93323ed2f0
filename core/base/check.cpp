#include "core/base/check.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace capstan::base {
namespace {

/// Path relative to the source tree, such as "core/robot/kinematics.cpp", of a compiler's absolute path.
std::string_view inTree(std::string_view path) {
  for (const std::string_view root : {"/tests/", "/widgets/", "/app/", "/core/"})
    if (const auto at = path.rfind(root); at != std::string_view::npos) return path.substr(at + 1);
  return path;
}

}  // namespace

void failCheck(const char* condition, const char* file, int line, const char* function) noexcept {
  const std::string_view place = inTree(file);
  std::fflush(stdout);
  std::fprintf(stderr, "capstan: %.*s:%d: %s: %s does not hold. This is a defect of the program\n",
               static_cast<int>(place.size()), place.data(), line, function, condition);
  std::abort();
}

}  // namespace capstan::base
