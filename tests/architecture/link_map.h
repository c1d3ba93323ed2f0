#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/include_graph.h"

/// What an executable is made of, as GNU ld's map (-Wl,-Map) tells it: of a static library it takes only the
/// objects that something calls for.
namespace capstan::architecture {

/// Objects that were taken from libraries: "libcapstan_robot.a(chain.cpp.o)". Empty where `map` is no map of
/// GNU ld.
std::set<std::string> objectsTaken(const std::string& map);

/// The object of `source`, relative to the root, of the innermost room that holds it; empty: of none.
std::string objectOf(const std::filesystem::path& source, const std::map<std::string, Room>& rooms);

/// Those of `sources` (relative to the root) whose object is not among `taken`.
std::vector<std::string> unreached(const std::vector<std::filesystem::path>& sources,
                                   const std::map<std::string, Room>& rooms,
                                   const std::set<std::string>& taken);

}  // namespace capstan::architecture
