#include "core/base/software.h"

#include "capstan_revision.h"

namespace capstan::base {

std::string software() {
  const std::string revision = CAPSTAN_REVISION;
  return "capstan " CAPSTAN_VERSION + (revision.empty() ? std::string() : " (" + revision + ")");
}

std::string version() { return CAPSTAN_VERSION; }

}  // namespace capstan::base
