#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/planted_study/answer.h"
#include "tests/support/planted_study/study_cases.h"

namespace capstan::study {

/// Planted effects of a recording, as the study stores them.
struct HiddenTruth {
  std::vector<test::Truth::Item> items;
  std::vector<test::Planted> texture;  ///< background texture of the recording; empty: it has none
  double duration = 0.0;               ///< duration of the recording [s]
  /// Size at which the ideal observer detects half of such effects, for the first item
  /// (IdealObserver::limit); NaN: not requested.
  double ideal_limit = 0.0;
};

/// Result of one case: what was planted, and the answer of the diagnosis.
struct CaseOutcome {
  StudyCase of;
  HiddenTruth truth;
  Answer answer;
};

nlohmann::json jsonOf(const CaseOutcome& outcome);
/// Outcome of its JSON. Throws nlohmann::json::exception, and std::invalid_argument for an unknown name.
CaseOutcome outcomeFrom(const nlohmann::json& json);

}  // namespace capstan::study
