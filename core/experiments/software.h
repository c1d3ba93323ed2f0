#pragma once

#include <string>

namespace capstan::experiments {

/// The program that computes: name, version and, in a git checkout, the commit that was built, as in
/// "capstan 1.2.0 (0123456789-dirty)". Results carry it, and kept trials of another one are run anew.
std::string software();

}  // namespace capstan::experiments
