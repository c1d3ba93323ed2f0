#pragma once

#include <cstddef>

namespace capstan::test {

/// Calls of malloc, calloc, realloc and their aligned kin in this process so far, shared libraries included.
/// Link counting_malloc.cpp into the program (glibc). Always 0 under a sanitizer, which owns malloc: ask
/// countsMalloc().
std::size_t mallocs();
bool countsMalloc();

}  // namespace capstan::test
