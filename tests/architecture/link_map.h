#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/include_graph.h"

/// What an executable is made of, according to the linker's map (-Map of GNU ld or gold, with --gc-sections).
/// Of a static library it takes the objects that something refers to, and of them the functions that are
/// referred to.
namespace capstan::architecture {

/// What executables took from static libraries.
struct LinkedParts {
  std::set<std::string> objects;  ///< "libcapstan_robot.a(chain.cpp.o)"
  /// Functions and variables of each library ("libcapstan_robot.a"), with the class or the namespace that
  /// holds them: "Chain::step", "robot::chainOf".
  std::map<std::string, std::set<std::string>> names;
};

/// Adds what `map` tells. Returns false where it is no map of GNU ld or gold.
bool addMap(const std::string& map, LinkedParts& parts);

/// A function or variable by its mangled name: "Chain::step" of _ZN7capstan5robot5Chain4stepEd. Empty for
/// names in anonymous namespaces and outside of namespaces.
std::string nameOfSymbol(std::string_view symbol);

/// The library of `source`, relative to the root: that of the innermost room that holds it; empty: of none.
std::string libraryOf(const std::filesystem::path& source, const std::map<std::string, Room>& rooms);

/// Those of `sources`, by path relative to the root with their texts, of which `parts` has nothing. A source
/// that is compiled alone is there when its object is; one that is compiled with others, when a function is
/// that no other source of its room defines. (Functions whose name others define too count where it has no
/// other.)
std::vector<std::string> unreached(const std::map<std::filesystem::path, std::string>& sources,
                                   const std::map<std::string, Room>& rooms, const LinkedParts& parts);

}  // namespace capstan::architecture
