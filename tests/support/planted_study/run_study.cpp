#include "tests/support/planted_study/run_study.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

namespace capstan::study {

void inParallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr fault;
  const auto workAll = [&] {
    try {
      for (std::size_t k = next++; k < count && !failed; k = next++) work(k);
    } catch (...) {
      if (!failed.exchange(true)) fault = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> crew;
    for (int k = 0; k < threads; ++k) crew.emplace_back(workAll);
  }
  if (fault) std::rethrow_exception(fault);
}

void runStudy(const std::vector<StudyCase>& cases, const Diagnoser& diagnoser, int threads, OutcomeFile& file,
              const std::function<void(const Step&)>& tell, const RunOptions& options) {
  std::vector<StudyCase> open;
  for (const StudyCase& one : cases)
    if (!file.find(one)) open.push_back(one);
  const auto begin = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::size_t done = 0;
  inParallel(open.size(), threads, [&](std::size_t k) {
    const CaseOutcome outcome = runCase(open[k], diagnoser, options);
    file.keep(outcome);
    const std::lock_guard lock(mutex);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    ++done;
    const double each = took.count() / static_cast<double>(done);
    if (tell) tell({outcome, done, open.size(), each * static_cast<double>(open.size() - done)});
  });
}

}  // namespace capstan::study
