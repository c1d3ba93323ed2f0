#pragma once

#include "app/version.h"

namespace capstan::cli {

/// Libraries of capstan-cli with their versions.
LibraryVersions libraries();

}  // namespace capstan::cli
