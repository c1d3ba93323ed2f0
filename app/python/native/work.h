#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "core/base/progress.h"

namespace capstan::python {

/// Calls `work` on another thread, without Python's lock, and waits for its end. Every 50 ms it handles
/// Python's signals and calls `report(fraction, doing)` if that is not None and the progress has changed.
/// When a signal handler (Ctrl-C) or `report` raises, the work is cancelled, and the exception is raised
/// after its end. An exception of `work` is rethrown.
void doCancellable(const pybind11::object& report, const std::function<void(base::Progress&)>& work);

/// Returns work(progress), called as by doCancellable().
template <class Work>
auto cancellable(const pybind11::object& report, Work&& work) {
  std::optional<decltype(work(std::declval<base::Progress&>()))> result;
  doCancellable(report, [&](base::Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

}  // namespace capstan::python
