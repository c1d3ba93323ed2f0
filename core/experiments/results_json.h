#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/experiments/results.h"

/// Results as JSON and back, to the last bit; not a number is null. Numbers and texts on one side, series
/// (trajectories, errors, traces) on the other, so that the first stay readable.
namespace capstan::experiments {

nlohmann::json numbersOf(const TrialResult& trial);
nlohmann::json seriesOf(const TrialResult& trial);
nlohmann::json numbersOf(const IdentificationResult& identification);
nlohmann::json seriesOf(const IdentificationResult& identification);

/// Throw nlohmann::json::exception where something is missing or of another kind.
void takeNumbers(const nlohmann::json& document, TrialResult& trial);
void takeSeries(const nlohmann::json& document, TrialResult& trial);
void takeNumbers(const nlohmann::json& document, IdentificationResult& identification);
void takeSeries(const nlohmann::json& document, IdentificationResult& identification);

/// The head of results.json: all but trials and identification.
nlohmann::json headOf(const Results& results);
void takeHead(const nlohmann::json& document, Results& results);

}  // namespace capstan::experiments
