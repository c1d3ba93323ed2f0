#pragma once

#include <string>

namespace capstan::base {

/// Name and version of this program and, when built in a git checkout, the commit, as in
/// "capstan 1.2.0 (0123456789-dirty)". experiments::Results store it; trials that another version computed
/// are run again.
std::string software();
/// The same with another name.
std::string software(const std::string& program);

/// Version of this program, as in "1.2.0".
std::string version();

}  // namespace capstan::base
