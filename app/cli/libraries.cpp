#include "app/cli/libraries.h"

#include <QtGlobal>

namespace capstan::cli {

LibraryVersions libraries() {
  LibraryVersions libraries = coreLibraries();
  libraries.emplace_back("Qt", qVersion());
  return libraries;
}

}  // namespace capstan::cli
