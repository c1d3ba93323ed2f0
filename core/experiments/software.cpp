#include "core/experiments/software.h"

#include "capstan_revision.h"

namespace capstan::experiments {

std::string software() {
  const std::string revision = CAPSTAN_REVISION;
  return "capstan " CAPSTAN_VERSION + (revision.empty() ? std::string() : " (" + revision + ")");
}

}  // namespace capstan::experiments
