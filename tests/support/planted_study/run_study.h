#pragma once

#include <functional>
#include <vector>

#include "tests/support/planted_study/outcome_file.h"
#include "tests/support/planted_study/run_case.h"

namespace capstan::study {

/// Progress of a study after a completed case.
struct Step {
  const CaseOutcome& outcome;
  std::size_t done = 0, of = 0;  ///< completed cases, and cases to run
  double seconds_left = 0.0;     ///< remaining time, at the same duration per case
};

/// Runs the cases that are not in `file`, in order, on `threads` threads, and stores each outcome at once.
/// `tell` is called after each case, by one thread at a time. Errors outside of the diagnosis (a full disk,
/// for example) stop the study and are rethrown; the outcomes so far are stored.
void runStudy(const std::vector<StudyCase>& cases, const Diagnoser& diagnoser, int threads, OutcomeFile& file,
              const std::function<void(const Step&)>& tell = {}, const RunOptions& options = {});

}  // namespace capstan::study
