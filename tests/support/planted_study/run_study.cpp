#include "tests/support/planted_study/run_study.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

namespace capstan::study {
namespace {

class Crew {
 public:
  Crew(std::vector<StudyCase> open, const std::function<void(const StudyCase&)>& work)
      : open_(std::move(open)), work_(work) {}

  void run(int threads) {
    {
      std::vector<std::jthread> crew;
      for (int k = 0; k < threads; ++k) crew.emplace_back([this] { work(); });
    }
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  void work() {
    try {
      for (std::size_t k = next_++; k < open_.size() && !failed_; k = next_++) work_(open_[k]);
    } catch (...) {
      if (!failed_.exchange(true)) fault_ = std::current_exception();
    }
  }

  std::vector<StudyCase> open_;
  const std::function<void(const StudyCase&)>& work_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::exception_ptr fault_;
};

}  // namespace

void runStudy(const std::vector<StudyCase>& cases, const Diagnoser& diagnoser, int threads, OutcomeFile& file,
              const std::function<void(const Step&)>& tell, const RunOptions& options) {
  std::vector<StudyCase> open;
  for (const StudyCase& one : cases)
    if (!file.find(one)) open.push_back(one);
  const auto begin = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::size_t done = 0;
  const std::size_t of = open.size();
  const std::function<void(const StudyCase&)> work = [&](const StudyCase& one) {
    const CaseOutcome outcome = runCase(one, diagnoser, options);
    file.keep(outcome);
    const std::lock_guard lock(mutex);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    ++done;
    const double each = took.count() / static_cast<double>(done);
    if (tell) tell({outcome, done, of, each * static_cast<double>(of - done)});
  };
  Crew(std::move(open), work).run(threads);
}

}  // namespace capstan::study
