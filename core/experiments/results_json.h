#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/experiments/results.h"

/// Conversion of results to JSON and back, exact to the last bit; NaN is null. Numbers and texts are separate
/// from series (trajectories, errors, traces), so that a person can read them.
namespace capstan::experiments {

nlohmann::json numbersOf(const TrialResult& trial);
nlohmann::json seriesOf(const TrialResult& trial);
nlohmann::json numbersOf(const IdentificationResult& identification);
nlohmann::json seriesOf(const IdentificationResult& identification);

/// Read a document into a result. Throw nlohmann::json::exception where a value is missing or of another
/// type.
void takeNumbers(const nlohmann::json& document, TrialResult& trial);
void takeSeries(const nlohmann::json& document, TrialResult& trial);
void takeNumbers(const nlohmann::json& document, IdentificationResult& identification);
void takeSeries(const nlohmann::json& document, IdentificationResult& identification);

/// Head of results.json: all fields except trials and identification.
nlohmann::json headOf(const Results& results);
void takeHead(const nlohmann::json& document, Results& results);

}  // namespace capstan::experiments
