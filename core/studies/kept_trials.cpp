#include "core/studies/kept_trials.h"

#include <fmt/format.h>

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

}  // namespace

KeptResults runKept(const std::vector<KeptTrial>& trials, const experiments::TrialStore& store, int threads,
                    base::Progress& progress) {
  KeptResults all;
  all.results.resize(trials.size());
  std::vector<base::Job> jobs;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const KeptTrial& trial = trials[i];
    std::string notice;
    auto kept = store.find(trial.name, trial.fingerprint, notice);
    if (!notice.empty()) all.notices.push_back(std::move(notice));
    if (kept) {
      all.results[i] = std::move(*kept);
      continue;
    }
    jobs.push_back(
        {trial.name, trial.weight, [&trial, &store, &result = all.results[i]](base::Progress& own) {
           nlohmann::json made = trial.run(own);
           if (own.cancelled()) return;
           store.keep(trial.name, trial.fingerprint, made);
           result = std::move(made);
         }});
  }
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

}  // namespace capstan::studies
