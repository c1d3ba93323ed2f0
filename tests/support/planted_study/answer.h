#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/diagnosis/report/report.h"

namespace capstan::study {

struct FoundNumber {
  std::string name;
  double value = 0.0, sigma = 0.0;  ///< SI
};

/// An effect that was named.
struct NamedCause {
  std::string effect;
  int joint = 0;  ///< from 1; 0: the whole arm or a camera
  double probability = 0.0;
  std::vector<FoundNumber> numbers;
};

/// An effect in the ranking of the first round.
struct RankedCause {
  std::string effect;
  int joint = 0;
  double reduction = 0.0, score = 0.0;  ///< diagnosis::Candidate; NaN: not refitted
};

/// What of a diagnosis::Report the study keeps.
struct Answer {
  std::string verdict;                        ///< "found", …; "error" where the diagnosis threw
  std::string summary;                        ///< what the report says of itself; the error's words
  std::vector<NamedCause> causes;             ///< first named first
  std::vector<std::vector<NamedCause>> ties;  ///< each best first
  std::vector<RankedCause> candidates;        ///< the kRanked of best score, refitted ones first
  double explained = 0.0;
  double seconds = 0.0;  ///< that the diagnosis took
};
inline constexpr std::size_t kRanked = 5;

Answer answerOf(const diagnosis::Report& report, double seconds);

nlohmann::json jsonOf(const Answer& answer);
/// Throws nlohmann::json::exception.
Answer answerFrom(const nlohmann::json& json);

/// A number as JSON writes it: null where it is not finite, and NaN back from null.
nlohmann::json numberOrNull(double value);
double numberOrNan(const nlohmann::json& value);

}  // namespace capstan::study
