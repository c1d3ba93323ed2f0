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

/// A case that is drawn and recorded.
struct RecordedCase {
  test::PlantedCase drawn;
  test::Recording recording;
  test::Truth truth;
};

/// Draws the case and records it. If the plant cannot integrate the case's robot, or if a varied case has an
/// effect that is not visible there (kJustVisible), another robot is drawn, by another seed. Of kMostRobots
/// robots in which it is not visible the last one stays.
RecordedCase recordCase(const StudyCase& one);
inline constexpr double kJustVisible = 0.8;  ///< Visibility 1, to which cases are sized within a quarter
inline constexpr std::uint64_t kMostRobots = 20;

/// Draws and records the case and runs the diagnosis, which gets only the recorded table and the nominal
/// robot. An exception of the diagnosis becomes the verdict "error".
CaseOutcome runCase(const StudyCase& one, const Diagnoser& diagnoser, const RunOptions& options = {});
/// The same for a case that is already drawn; `one` gives its name.
CaseOutcome runCase(const StudyCase& one, const test::PlantedCase& drawn, const Diagnoser& diagnoser,
                    const RunOptions& options = {});

}  // namespace capstan::study
