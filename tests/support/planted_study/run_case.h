#pragma once

#include <functional>

#include "core/diagnosis/evidence/evidence.h"
#include "tests/support/planted_study/case_outcome.h"

namespace capstan::study {

/// What is put to the test: diagnosis::diagnose, or something in its place.
using Diagnoser = std::function<diagnosis::Report(const std::vector<diagnosis::Evidence>& recordings,
                                                  const robot::Description& nominal)>;

struct RunOptions {
  bool ideal_limit = true;  ///< also HiddenTruth::ideal_limit, of cases with one effect
};

/// Draws the case, records it and has it diagnosed. The diagnosis sees the recording's table, the nominal
/// robot and what drives it, nothing else. What it throws becomes the answer's verdict "error".
CaseOutcome runCase(const StudyCase& one, const Diagnoser& diagnoser, const RunOptions& options = {});
/// The same of a case that was drawn otherwise; `one` is its name.
CaseOutcome runCase(const StudyCase& one, const test::PlantedCase& drawn, const Diagnoser& diagnoser,
                    const RunOptions& options = {});

}  // namespace capstan::study
