#pragma once

#include <string>

namespace capstan::base {

/// The program that computes: name, version and, in a git checkout, the commit that was built, as in
/// "capstan 1.2.0 (0123456789-dirty)". experiments::Results carry it, and kept trials of another one are run
/// again.
std::string software();

/// "1.2.0"
std::string version();

}  // namespace capstan::base
