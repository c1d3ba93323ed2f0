#pragma once

#include <cstddef>

namespace capstan::test {

/// Number of calls of operator new in this program so far. Link counting_new.cpp into the test.
std::size_t allocations();

}  // namespace capstan::test
