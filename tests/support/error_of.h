#pragma once

#include <string>

#include "core/base/error.h"

namespace capstan::test {

/// Message of the exception that work() throws; empty: none. Other exceptions than Error pass through.
template <class Error = base::InputError, class Work>
std::string errorOf(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace capstan::test
