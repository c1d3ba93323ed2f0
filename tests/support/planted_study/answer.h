#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/diagnosis/report/report.h"

namespace capstan::study {

/// Estimated parameter of a named cause.
struct FoundNumber {
  std::string name;
  double value = 0.0, sigma = 0.0;  ///< SI
};

/// Effect that the diagnosis identified as a cause.
struct NamedCause {
  std::string effect;
  int joint = 0;  ///< from 1; 0: the whole arm or a camera
  double probability = 0.0;
  std::vector<FoundNumber> numbers;
};

/// Effect in the ranking of the first round.
struct RankedCause {
  std::string effect;
  int joint = 0;
  double reduction = 0.0, score = 0.0;  ///< diagnosis::Candidate; NaN: not refitted
};

/// Part of a diagnosis::Report that the study stores.
struct Answer {
  std::string verdict;                        ///< "found", …; "error" where the diagnosis threw
  std::string summary;                        ///< Report::summary, or the error message
  std::vector<NamedCause> causes;             ///< in the order of the report
  std::vector<std::vector<NamedCause>> ties;  ///< each with the best first
  std::vector<RankedCause> candidates;        ///< the kRanked best, refitted ones first
  double explained = 0.0;
  double seconds = 0.0;  ///< duration of the diagnosis
};
inline constexpr std::size_t kRanked = 5;

Answer answerOf(const diagnosis::Report& report, double seconds);

nlohmann::json jsonOf(const Answer& answer);
/// Answer of its JSON. Throws nlohmann::json::exception.
Answer answerFrom(const nlohmann::json& json);

/// Number as JSON; null if it is not finite.
nlohmann::json numberOrNull(double value);
/// Number of its JSON; NaN for null.
double numberOrNan(const nlohmann::json& value);

}  // namespace capstan::study
