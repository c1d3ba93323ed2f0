#include "app/python/native/work.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace capstan::python {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kPoll{50};

/// A thread that calls a function and keeps its exception.
class Worker {
 public:
  Worker(const std::function<void(base::Progress&)>& work, base::Progress& progress)
      : thread_([this, &work, &progress] {
          try {
            work(progress);
          } catch (...) {
            fault_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          ended_ = true;
          end_.notify_one();
        }) {}

  /// Waits for the end, at most for kPoll. True: it has ended.
  bool wait() {
    std::unique_lock lock(mutex_);
    return end_.wait_for(lock, kPoll, [this] { return ended_; });
  }
  void finish() {
    thread_.join();
    if (fault_) std::rethrow_exception(fault_);
  }
  void join() { thread_.join(); }

 private:
  std::mutex mutex_;
  std::condition_variable end_;
  bool ended_ = false;
  std::exception_ptr fault_;
  std::thread thread_;  ///< last, because it uses the others
};

/// Calls the user's function when the progress has changed.
class Reporter {
 public:
  explicit Reporter(const py::object& report) : report_(report) {}
  void operator()(const base::Progress& progress) {
    if (report_.is_none()) return;
    const double fraction = progress.fraction();
    std::string doing = progress.doing();
    if (fraction == fraction_ && doing == doing_) return;
    fraction_ = fraction;
    doing_ = std::move(doing);
    report_(fraction_, doing_);
  }

 private:
  const py::object& report_;
  double fraction_ = 0.0;
  std::string doing_;
};

}  // namespace

void doCancellable(const py::object& report, const std::function<void(base::Progress&)>& work) {
  base::Progress progress;
  Worker worker(work, progress);
  Reporter reporter(report);
  std::exception_ptr raised;
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release unlocked;
      ended = worker.wait();
    }
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      reporter(progress);
    } catch (...) {
      raised = std::current_exception();
      progress.cancel();
    }
  }
  if (raised) {
    worker.join();
    std::rethrow_exception(raised);
  }
  worker.finish();
}

}  // namespace capstan::python
