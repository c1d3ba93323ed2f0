#pragma once

#include <functional>
#include <vector>

#include "tests/support/planted_study/outcome_file.h"
#include "tests/support/planted_study/run_case.h"

namespace capstan::study {

/// A case that was just done.
struct Step {
  const CaseOutcome& outcome;
  std::size_t done = 0, of = 0;  ///< of those that had to be run
  double seconds_left = 0.0;     ///< if the others take as long
};

/// Runs the cases that `file` does not hold, `threads` at a time in their order, and keeps each at once.
/// `tell` is called after each, by one thread at a time. What is no answer of the diagnosis (a full disk,
/// say) stops the study and is thrown on; what was done by then is kept.
void runStudy(const std::vector<StudyCase>& cases, const Diagnoser& diagnoser, int threads, OutcomeFile& file,
              const std::function<void(const Step&)>& tell = {}, const RunOptions& options = {});

}  // namespace capstan::study
