#pragma once

#include <tl/expected.hpp>

namespace capstan::base {

/// A value, or the reason why there is none in normal operation (occluded, out of reach, end of file).
/// Wrong arguments and wrong files throw exceptions (error.h); our own defects are assertions.
template <class T, class E>
using Result = tl::expected<T, E>;

template <class E>
auto failure(E reason) {
  return tl::unexpected<E>(std::move(reason));
}

}  // namespace capstan::base
