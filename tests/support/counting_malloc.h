#pragma once

#include <cstddef>

namespace capstan::test {

/// Number of calls of malloc, calloc, realloc and their aligned variants in this process so far, shared
/// libraries included. Link counting_malloc.cpp into the program (glibc). Always 0 under a sanitizer, which
/// replaces malloc; countsMalloc() is then false.
std::size_t mallocs();
bool countsMalloc();

}  // namespace capstan::test
