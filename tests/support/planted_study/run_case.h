#pragma once

#include <functional>

#include "core/diagnosis/evidence/evidence.h"
#include "tests/support/planted_study/case_outcome.h"

namespace capstan::study {

/// Function under test: diagnosis::diagnose, or a replacement.
using Diagnoser = std::function<diagnosis::Report(const std::vector<diagnosis::Evidence>& recordings,
                                                  const robot::Description& nominal)>;

struct RunOptions {
  bool ideal_limit = true;  ///< true: compute HiddenTruth::ideal_limit for cases with one effect
};

/// Draws the case, records it and runs the diagnosis, which gets only the recorded table and the nominal
/// robot. An exception of the diagnosis becomes the verdict "error".
/// If the plant cannot integrate the case's robot, another one is drawn, by another seed.
CaseOutcome runCase(const StudyCase& one, const Diagnoser& diagnoser, const RunOptions& options = {});
/// The same for a case that is already drawn; `one` gives its name.
CaseOutcome runCase(const StudyCase& one, const test::PlantedCase& drawn, const Diagnoser& diagnoser,
                    const RunOptions& options = {});

}  // namespace capstan::study
