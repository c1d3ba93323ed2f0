#include "core/experiments/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>

#include "core/base/error.h"
#include "core/base/same_recording.h"
#include "core/base/workers.h"
#include "core/experiments/identify_trials.h"
#include "core/experiments/results_json.h"
#include "core/experiments/track_trial.h"
#include "core/experiments/trial_setup.h"
#include "core/experiments/trial_store.h"

namespace capstan::experiments {
namespace {

using nlohmann::json;

[[noreturn]] void refuseNeed(const Specification& specification, const std::string& name,
                             const std::string& reason, const std::string& remedy) {
  throw base::InputError(
      {specification.file.string(), specification.lineOf({}, "robot"), "robot", name, reason, remedy});
}

/// The experiment `name` that identifies the robot of `specification`.
Specification neededBy(const Specification& specification, const std::string& name) {
  Specification needed;
  try {
    needed = findSpecification(name, specification.file);
  } catch (const base::InputError& error) {
    if (error.fault().key != "experiment") throw;
    refuseNeed(specification, name, error.fault().reason, error.fault().remedy);
  }
  if (needed.work != Work::kIdentify)
    refuseNeed(specification, name, "identifies no robot", "Name an experiment of work: identify");
  if (needed.name != name)
    refuseNeed(specification, name, fmt::format("calls itself {} in {}", needed.name, needed.file.string()),
               "Use one name");
  return needed;
}

/// Experiments in the order of work: those that `specification` needs, then itself, each once. Throws
/// base::InputError for a circle and for a needed experiment that identifies nothing.
void planFor(const Specification& specification, std::vector<std::string>& above,
             std::vector<Specification>& plan) {
  const auto same = [&](const Specification& one) { return one.name == specification.name; };
  if (std::any_of(plan.begin(), plan.end(), same)) return;
  above.push_back(specification.name);
  for (const std::string& name : specification.needs()) {
    if (std::find(above.begin(), above.end(), name) != above.end())
      refuseNeed(specification, name, "needs this experiment itself", "Break the circle");
    const Specification needed = neededBy(specification, name);
    planFor(needed, above, plan);
  }
  above.pop_back();
  plan.push_back(specification);
}

double weightOf(const Specification& specification) {
  double sum = 0.0;
  for (const TrialSpec& trial : specification.trials) sum += trial.duration;
  return specification.work == Work::kIdentify ? 2.0 * sum : sum;
}

/// Throws base::InputError when a recording would count twice: in an identification, or in trials that are
/// tracked with the same occlusion.
void checkRepeats(const Specification& specification) {
  const std::vector<TrialSpec>& trials = specification.trials;
  const auto counted = [&](const TrialSpec& a, const TrialSpec& b) {
    const bool alike = a.occlusion.percentage == b.occlusion.percentage &&
                       (a.occlusion.percentage == 0.0 || a.occlusion.interval == b.occlusion.interval);
    return (specification.work == Work::kIdentify || alike) && !a.recording.empty() && !b.recording.empty() &&
           base::sameRecording(specification.resolved(a.recording), specification.resolved(b.recording));
  };
  for (std::size_t i = 0; i < trials.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (counted(trials[j], trials[i]))
        throw base::InputError(
            {specification.file.string(), specification.lineOf(trials[i].name, "recording"),
             fmt::format("trial {}: recording", trials[i].name), trials[i].recording,
             fmt::format("is the recording of trial {}, too: it would count twice", trials[j].name),
             "Give each recording once"});
}

/// Reads every file of `specification`, so that errors in files are found before hours of work.
void checkFiles(const Specification& specification, const RunOptions& options) {
  const RobotBelief belief = beliefOf(specification, {});
  const bool images = options.images.value_or(specification.images);
  for (const TrialSpec& trial : specification.trials) {
    const TrialSetup setup = setUpTrial(specification, trial, belief, images, options.software);
    if (specification.work == Work::kIdentify) (void)setUpIdentification(specification, setup.table_robot);
  }
  checkRepeats(specification);
}

constexpr const char* kIdentification = "identification";  ///< name of the stored identification

std::filesystem::path storeOf(const Specification& specification, const RunOptions& options) {
  return options.out.empty() ? std::filesystem::path() : options.out / specification.name / "trials";
}

/// Names of the results that are computed independently of each other.
std::vector<std::string> unitsOf(const Specification& specification) {
  if (specification.work == Work::kIdentify) return {kIdentification};
  std::vector<std::string> names;
  for (const TrialSpec& trial : specification.trials) names.push_back(trial.name);
  return names;
}

/// Which of unitsOf() are computed or read.
std::vector<bool> includedUnits(const Specification& specification, const PartialRun* part) {
  std::vector<bool> included;
  for (std::size_t k = 0; k < unitsOf(specification).size(); ++k) included.push_back(includes(part, k));
  return included;
}

/// Run of one experiment, given the results of the experiments that it needs.
class Experiment {
 public:
  Experiment(const Specification& specification, const RunOptions& options,
             const std::vector<IdentificationResult>& found, const std::vector<bool>& included)
      : specification_(specification), options_(options), store_(storeOf(specification, options)) {
    const RobotBelief belief = beliefOf(specification, found);
    const bool images = options.images.value_or(specification.images);
    for (std::size_t i = 0; i < specification.trials.size(); ++i) {
      if (specification.work == Work::kTrack && !included[i]) continue;
      setups_.push_back(setUpTrial(specification, specification.trials[i], belief, images, options.software));
      setups_.back().addChecksum();
    }
    results_.name = specification.name;
    results_.title = specification.title;
    results_.work = specification.work;
    results_.software = options.software;
    results_.specification = specification.text;
  }

  Results run(const base::ProgressSlice& progress) {
    const auto begin = std::chrono::steady_clock::now();
    if (specification_.work == Work::kTrack)
      track(progress);
    else
      identify(progress);
    results_.cancelled = progress.whole.cancelled() && !complete_;
    results_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!options_.out.empty())
      results_.kept = results_.identification ? static_cast<int>(setups_.size())
                                              : static_cast<int>(results_.trials.size());
    if (!results_.cancelled && !isShard()) finish();
    return std::move(results_);
  }

 private:
  std::filesystem::path folder() const { return options_.out / specification_.name; }
  bool isShard() const { return options_.part != nullptr && options_.part->isShard(); }

  void track(const base::ProgressSlice& progress) {
    std::vector<TrialResult> trials(setups_.size());
    std::vector<char> done(setups_.size(), 0);
    std::vector<base::Job> jobs;
    for (std::size_t i = 0; i < setups_.size(); ++i) {
      if (takeKept(setups_[i], trials[i])) {
        done[i] = 1;
        continue;
      }
      jobs.push_back({setups_[i].spec.name, setups_[i].weight(), [this, &trials, &done, i](auto& own) {
                        trials[i] = trackTrial(setups_[i], own);
                        if (own.cancelled()) return;
                        keep(setups_[i].spec.name, setups_[i].fingerprint, trials[i], trials[i].seconds,
                             trials[i].seconds);
                        done[i] = 1;
                      }});
    }
    results_.resumed = static_cast<int>(setups_.size() - jobs.size());
    base::doAll(jobs, options_.threads, progress);
    complete_ = std::all_of(done.begin(), done.end(), [](char one) { return one != 0; });
    for (std::size_t i = 0; i < trials.size(); ++i)
      if (done[i] != 0) results_.trials.push_back(std::move(trials[i]));
    for (const TrialResult& trial : results_.trials) results_.simulated &= trial.simulated;
  }

  void identify(const base::ProgressSlice& progress) {
    IdentificationSetup setup = setUpIdentification(specification_, setups_.front().table_robot);
    setup.software = options_.software;
    json fingerprint = {{"identification", setup.fingerprint}, {"trials", json::array()}};
    for (const TrialSetup& trial : setups_) fingerprint["trials"].push_back(trial.fingerprint);
    IdentificationResult result;
    if (takeKept(kIdentification, fingerprint, result, [&](const json& seconds) {
          result.collect_seconds = seconds.at(0);
          result.dual_seconds = seconds.at(1);
          result.batch_seconds = seconds.at(2);
        })) {
      results_.resumed = static_cast<int>(setups_.size());
    } else {
      result = identifyTrials(setups_, setup, options_.threads, progress);
      if (progress.whole.cancelled()) return;
      if (!result.found)
        throw base::InputError({specification_.file.string(),
                                specification_.lineOf({}, "trials"),
                                "trials",
                                {},
                                result.choice,
                                "Give trials in which the robot moves before the cameras, and look at their "
                                "motor encoders (capstan-cli info)"});
      keep(kIdentification, fingerprint, result,
           json{result.collect_seconds, result.dual_seconds, result.batch_seconds},
           result.collect_seconds + result.dual_seconds + result.batch_seconds);
    }
    if (result.method != specification_.identification.robot)
      results_.notices.push_back(fmt::format(
          "{}: {}", specification_.name,
          result.choice.empty() ? fmt::format("an earlier run found nothing by the requested method: "
                                              "the result is that of {}",
                                              base::nameOf(result.method))
                                : result.choice));
    complete_ = true;
    results_.simulated = !result.inputs.truth.empty();
    results_.identification = std::move(result);
  }

  bool takeKept(const TrialSetup& setup, TrialResult& trial) {
    return takeKept(setup.spec.name, setup.fingerprint, trial,
                    [&](const json& seconds) { trial.seconds = seconds.get<double>(); });
  }

  template <class Result, class TakeSeconds>
  bool takeKept(const std::string& name, const json& fingerprint, Result& result, TakeSeconds&& take) {
    std::string reason;
    const auto kept = store_.find(name, fingerprint, reason);
    if (!kept && options_.part != nullptr && !isShard()) refuseStored(store_.fileOf(name), reason);
    if (!reason.empty())
      results_.notices.push_back(
          fmt::format("{}: {}; this trial is run again", store_.fileOf(name).string(), reason));
    if (!kept) return false;
    takeNumbers(kept->at("numbers"), result);
    takeSeries(kept->at("series"), result);
    take(kept->at("seconds"));
    return true;
  }

  template <class Result>
  void keep(const std::string& name, const json& fingerprint, const Result& result, const json& seconds,
            double elapsed) {
    store_.keep(name, fingerprint,
                {{"numbers", numbersOf(result)}, {"series", seriesOf(result)}, {"seconds", seconds}},
                elapsed);
  }

  /// Writes the results. Where nothing was computed, the computing time of the earlier run is kept.
  void finish() {
    if (options_.out.empty()) return;
    if (results_.resumed == static_cast<int>(setups_.size())) {
      try {
        results_.wall_seconds = readResults(folder()).wall_seconds;
      } catch (const base::InputError&) {
        results_.wall_seconds = kNone;  // the run that computed them was stopped before it had written
      }
    }
    writeResults(results_, folder());
  }

  const Specification& specification_;
  const RunOptions& options_;
  TrialStore store_;
  std::vector<TrialSetup> setups_;
  Results results_;
  bool complete_ = false;
};

}  // namespace

Results run(const Specification& specification, const RunOptions& options, base::Progress& progress) {
  std::vector<Specification> plan;
  std::vector<std::string> above;
  planFor(specification, above, plan);
  double total = 0.0, before = 0.0;
  for (const Specification& one : plan) {
    checkFiles(one, options);
    total += weightOf(one);
  }
  const std::vector<bool> included = includedUnits(specification, options.part);
  if (options.part != nullptr) options.part->add(storeOf(specification, options), unitsOf(specification));
  if (std::find(included.begin(), included.end(), true) == included.end()) return {};
  std::map<std::string, IdentificationResult> found;
  std::vector<std::string> notices;
  int kept = 0;
  for (const Specification& one : plan) {
    std::vector<IdentificationResult> needed;
    for (const std::string& name : one.needs()) needed.push_back(found.at(name));
    const double after = before + weightOf(one);
    const bool last = one.name == specification.name;
    if (options.part != nullptr && !last) options.part->addShared(storeOf(one, options), kIdentification);
    Results results = Experiment(one, options, needed, last ? included : std::vector<bool>{true})
                          .run({progress, before / total, after / total});
    before = after;
    notices.insert(notices.end(), results.notices.begin(), results.notices.end());
    results.kept = kept += results.kept;
    if (results.cancelled || last) {
      results.notices = notices;
      return results;
    }
    found[one.name] = *results.identification;
  }
  return {};
}

}  // namespace capstan::experiments
