#include "tests/support/planted_study/run_study.h"

#include <chrono>
#include <mutex>

#include "core/base/parallel.h"

namespace capstan::study {

void runStudy(const std::vector<StudyCase>& cases, const Diagnoser& diagnoser, int threads, OutcomeFile& file,
              const std::function<void(const Step&)>& tell, const RunOptions& options) {
  std::vector<StudyCase> open;
  for (const StudyCase& one : cases)
    if (!file.find(one)) open.push_back(one);
  const auto begin = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::size_t done = 0;
  base::parallelFor(open.size(), threads, [&](std::size_t k) {
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
