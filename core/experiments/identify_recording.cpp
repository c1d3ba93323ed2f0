#include "core/experiments/identify_recording.h"

#include <algorithm>

#include "core/identification/delay_passes.h"

namespace capstan::experiments {
namespace {

/// Chooses among the methods that ran, and removes the estimates of a method without usable ones.
void chooseAmong(Identified& found) {
  const auto* dual = found.dual ? &*found.dual : nullptr;
  const auto* batch = found.batch ? &*found.batch : nullptr;
  found.choice = choose(batch ? Method::kBatch : Method::kDualUkf, dual, batch);
  if (dual && !choose(Method::kDualUkf, dual, nullptr).method) found.dual->estimates.clear();
  if (batch && !choose(Method::kBatch, nullptr, batch).method) found.batch->estimates.clear();
}

}  // namespace

const std::vector<identification::Estimate>& Identified::estimates() const {
  return *choice.method == Method::kBatch ? batch->estimates : dual->estimates;
}

bool Identified::anySeen() const {
  if (!choice.method) return false;
  const auto& all = estimates();
  return std::any_of(all.begin(), all.end(), [](const auto& estimate) { return estimate.seen; });
}

Identified identifyRecording(const identification::IdentificationData& data,
                             const identification::ParameterSet& set, const IdentifyOptions& options,
                             base::Progress& progress) {
  Identified found{set};
  const identification::DualUkfReport dual =
      identification::identifyDualUkfInPasses(data, set, {.camera = options.camera}, &progress);
  if (options.dual) found.dual = dual;
  if (options.batch && !progress.cancelled()) {
    identification::BatchOptions batch{.camera = options.camera, .shooting = {.threads = options.threads}};
    if (choose(Method::kDualUkf, &dual, nullptr).method) batch.start = identification::logsOf(dual.estimates);
    found.batch = identification::identifyBatchInPasses(data, set, batch, &progress);
  }
  chooseAmong(found);
  return found;
}

}  // namespace capstan::experiments
