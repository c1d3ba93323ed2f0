#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/planted_study/answer.h"
#include "tests/support/planted_study/study_cases.h"

namespace capstan::study {

/// What was hidden in a recording, as the study keeps it.
struct HiddenTruth {
  std::vector<test::Truth::Item> items;
  std::vector<test::Planted> texture;  ///< background texture of the recording; empty: it has none
  double duration = 0.0;               ///< of the recording [s]
  /// Size at which the true model would find half of the first item's like, IdealObserver::limit; NaN: not
  /// requested.
  double ideal_limit = 0.0;
};

/// One case, what was hidden in it and what was said of it.
struct CaseOutcome {
  StudyCase of;
  HiddenTruth truth;
  Answer answer;
};

nlohmann::json jsonOf(const CaseOutcome& outcome);
/// Throws nlohmann::json::exception, and std::invalid_argument for a name that is none.
CaseOutcome outcomeFrom(const nlohmann::json& json);

}  // namespace capstan::study
