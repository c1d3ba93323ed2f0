#include "core/studies/kept_trials.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "core/base/workers.h"

namespace capstan::studies {
namespace {

/// Shortens the list of notices: many stored trials may have the same problem.
std::vector<std::string> summedUp(const std::vector<std::string>& notices) {
  constexpr std::size_t kNamed = 2;
  if (notices.size() <= kNamed + 1) return notices;
  std::vector<std::string> few(notices.begin(), notices.begin() + kNamed);
  few.push_back(fmt::format("and {} more such files", notices.size() - kNamed));
  return few;
}

std::vector<std::string> namesOf(const std::vector<KeptTrial>& trials) {
  std::vector<std::string> names;
  for (const KeptTrial& trial : trials) names.push_back(trial.name);
  return names;
}

}  // namespace

KeptResults runKept(const std::vector<KeptTrial>& trials, const experiments::TrialStore& store, int threads,
                    base::Progress& progress, experiments::PartialRun* part) {
  KeptResults all;
  all.results.resize(trials.size());
  all.shard = part != nullptr && part->isShard();
  const bool stored_only = part != nullptr && !all.shard;
  std::vector<base::Job> jobs;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const KeptTrial& trial = trials[i];
    if (!experiments::includes(part, i)) continue;
    std::string reason;
    auto kept = store.find(trial.name, trial.fingerprint(), reason);
    if (!kept && stored_only) experiments::refuseStored(store.fileOf(trial.name), reason);
    if (!reason.empty())
      all.notices.push_back(
          fmt::format("{}: {}; this trial is run again", store.fileOf(trial.name).string(), reason));
    if (kept) {
      all.results[i] = std::move(*kept);
      continue;
    }
    jobs.push_back(
        {trial.name, trial.weight, [&trial, &store, &result = all.results[i]](base::Progress& own) {
           const auto begin = std::chrono::steady_clock::now();
           nlohmann::json made = trial.run(own);
           if (own.cancelled()) return;
           const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
           store.keep(trial.name, trial.fingerprint(), made, elapsed.count());
           result = std::move(made);
         }});
  }
  if (part != nullptr) part->add(store.folder(), namesOf(trials));
  base::doAll(jobs, threads, {progress});
  all.notices = summedUp(all.notices);
  all.cancelled = progress.cancelled();
  return all;
}

nlohmann::json numberOrNull(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

double numberOrNan(const nlohmann::json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

nlohmann::json vectorOrNull(const Eigen::Vector3d& v) {
  return {numberOrNull(v(0)), numberOrNull(v(1)), numberOrNull(v(2))};
}

Eigen::Vector3d vectorOrNan(const nlohmann::json& value) {
  return {numberOrNan(value.at(0)), numberOrNan(value.at(1)), numberOrNan(value.at(2))};
}

}  // namespace capstan::studies
