#include <cmath>

#include "core/experiments/results.h"
#include "core/experiments/shard_record.h"
#include "core/experiments/trial_store.h"
#include "tests/fuzz/fuzz_target.h"

/// Folder of results: results.json, series.json, shard.json and a stored trial, "====" between them. Results
/// that can be read are written, and read again.
CAPSTAN_FUZZ_TARGET(experiment_results) {
  using namespace capstan;
  const auto parts = fuzz::partsOf(bytes, 4);
  const auto folder = fuzz::fileOf(parts[0], "results.json").parent_path();
  fuzz::fileOf(parts[1], "series.json");
  fuzz::fileOf(parts[2], "shard.json");
  fuzz::allowInputError([&] {
    const experiments::Results results = experiments::readResults(folder);
    const auto again = fuzz::emptyFolder();
    experiments::writeResults(results, again);
    experiments::readResults(again);
  });
  fuzz::allowInputError([&] {
    const experiments::ShardRecord record = experiments::readRecord(folder);
    fuzz::require(record.shard.index >= 1 && record.shard.index <= record.shard.count, "a shard of a set");
    fuzz::require(record.own() <= record.trials(), "a shard has at most all trials");
  });
  fuzz::allowInputError([&] { experiments::readStoredTrial(fuzz::fileOf(parts[3], "trial.json")); });
}
