#include "core/base/software.h"

#include "capstan_revision.h"

namespace capstan::base {

std::string software() { return software("capstan"); }

std::string software(const std::string& program) {
  const std::string revision = CAPSTAN_REVISION;
  return program + " " CAPSTAN_VERSION + (revision.empty() ? std::string() : " (" + revision + ")");
}

std::string version() { return CAPSTAN_VERSION; }

}  // namespace capstan::base
