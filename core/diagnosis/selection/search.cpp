#include "core/diagnosis/selection/search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

#include "core/diagnosis/selection/optimism.h"
#include "core/diagnosis/selection/search_limits.h"
#include "core/diagnosis/selection/search_progress.h"
#include "core/diagnosis/selection/tested_candidates.h"

namespace capstan::diagnosis {
namespace {

using namespace limits;

bool cancelled(const base::Progress* progress) { return progress && progress->cancelled(); }

class Search {
 public:
  Search(const FitData& data, const std::vector<Evidence>& recordings, const SearchOptions& options,
         base::Progress* progress)
      : data_(data),
        recordings_(recordings),
        options_(options),
        progress_(progress),
        fitter_(data),
        shown_(data, recordings, progress, options.progress_end, options.effort * kMostWork) {}

  SearchResult run(const FitModel& nominal, const Fit* start) {
    report("Refitting the nominal structure");
    SetFit base = fitter_.nominal(nominal, start ? nominal.carry(start->model, start->u)
                                                 : Eigen::VectorXd(Eigen::VectorXd::Zero(nominal.size())));
    found_.channels = scoredChannels(data_, base.fit, base.weighting);
    found_.prior =
        SetPrior(recordings_, static_cast<int>(candidatesOf(recordings_, nominal, options_.only).size()));
    score_.emplace(found_.channels, data_.blocks(), kDraws, options_.seed);
    keep(std::move(base));
    if (start) tryStart(*start);
    while (!cancelled(progress_) &&
           (restartBest() || expandBeam() || expandNeighbours() || settleContenders())) {
    }
    finish();
    return std::move(found_);
  }

 private:
  /// True if no further fits may begin. Ask it last: where something was left to do, the search is not
  /// complete.
  bool ends() {
    if (data_.work() > options_.effort * kMostWork) found_.complete = false;
    return !found_.complete || cancelled(progress_);
  }

  double prior(const SetFit& set) const { return found_.prior.of(set); }

  /// Score on held-out blocks and log prior of a settled set [nats].
  double value(const EffectSet& effects) const { return value_.at(effects); }

  /// Values of all settled sets; the best one.
  void weigh() {
    value_ = heldOutScores(found_.sets, *score_);
    for (auto& [effects, value] : value_) value += prior(at(effects));
    for (const auto& [effects, value] : value_)
      if (value > value_.at(found_.best)) found_.best = effects;
  }

  /// The same of the fit's own residuals, which short fits have, too.
  double fittedValue(const SetFit& set) const { return score_->of(set.fitted) + prior(set); }

  SetFit& at(const EffectSet& effects) { return found_.sets.at(effects); }

  /// Of two fits of the same set a settled one stays, else the better one. True: this set has become the
  /// best.
  bool keep(SetFit set) {
    if (set.settled) score_->learnInflation(set.squares);
    const EffectSet effects = set.effects, former = found_.best;
    const auto known = found_.sets.find(effects);
    if (known == found_.sets.end())
      found_.sets.emplace(effects, std::move(set));
    else if (set.settled != known->second.settled ? set.settled : isBetter(set, known->second))
      known->second = std::move(set);
    weigh();  // what was learned may have changed the order of others, too
    if (found_.best != former && !former.empty()) SetFitter::thin(at(former));
    return found_.best == effects && former != effects;
  }

  /// Of two fits of the same set.
  bool isBetter(const SetFit& one, const SetFit& other) const {
    return score_->of(one.squares) + prior(one) > score_->of(other.squares) + prior(other);
  }

  bool isSettled(const EffectSet& effects) const {
    const auto known = found_.sets.find(effects);
    return known != found_.sets.end() && known->second.settled;
  }

  void tryStart(const Fit& start) {
    EffectSet effects;
    for (const EffectTerm& term : start.model.effects())
      if (!term.background) effects = plus(std::move(effects), {term.hypothesis, term.joint});
    if (!effects.empty()) keep(fitter_.settled(fitter_.extended(at({}), effects, start)));
  }

  /// Sets within reach of the best one, the best first.
  std::vector<EffectSet> ranked() {
    std::vector<std::pair<double, EffectSet>> all;
    const double least = value(found_.best) - kWindow;
    for (const auto& [effects, value] : value_)
      if (value > least) all.emplace_back(value, effects);
    std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<EffectSet> sets;
    for (auto& [score, effects] : all) sets.push_back(std::move(effects));
    return sets;
  }

  /// Expands those of the kBeam best sets that were not expanded yet. False: there is none.
  bool expandBeam() {
    std::vector<EffectSet> sets = ranked();
    sets.resize(std::min(sets.size(), isFar(at(found_.best)) ? kFarBeam : kBeam));
    bool any = false;
    for (const EffectSet& effects : sets) {
      if (expanded_.contains(effects) || ends()) continue;
      expanded_.insert(effects);
      expand(effects, {.refits = options_.refits, .settled = kSettled, .least = 0.0});
      any = true;
    }
    return any;
  }

  /// Expands the sets with one and then those with two effects less than the best one. True: one led to a
  /// better set.
  bool expandNeighbours() {
    const EffectSet best = found_.best;
    std::vector<EffectSet> one_less, two_less;
    for (const EffectCandidate& effect : best) one_less.push_back(minus(best, effect));
    for (std::size_t i = 0; i < best.size() && best.size() > 2; ++i)
      for (std::size_t j = i + 1; j < best.size(); ++j)
        two_less.push_back(minus(minus(best, best[i]), best[j]));
    return expandSmaller(best, one_less) || expandSmaller(best, two_less);
  }

  /// Expands subsets of the best set. True: one led to a better set.
  bool expandSmaller(const EffectSet& best, const std::vector<EffectSet>& smaller) {
    shrinkTo(smaller, best);
    for (const EffectSet& effects : smaller) {
      if (found_.best != best) return true;
      if (cancelled(progress_) || !found_.sets.contains(effects)) return false;
      if (expanded_.contains(effects)) continue;
      if (ends()) return false;
      expanded_.insert(effects);
      expand(effects, {.refits = kNeighbourRefits,
                       .settled = kNeighbourSettled,
                       .least = kHopeful * (fittedValue(at(best)) - fittedValue(at(effects)))});
    }
    return found_.best != best;
  }

  /// Fits to the end what a short fit has brought near the best set. True: there was such a set.
  bool settleContenders() {
    std::vector<SetFit> sets;
    for (auto& [effects, set] : found_.sets)
      if (!set.settled && fittedValue(set) > fittedValue(at(found_.best)) - kContend) sets.push_back(set);
    if (sets.empty() || ends()) return false;
    sortByFit(sets);
    if (sets.size() > kContenders) sets.erase(sets.begin() + kContenders, sets.end());
    begin("Settling the candidate models");
    for (SetFit& set : sets) fitter_.relinearise(set);
    keepThin(fitter_.settled(std::move(sets)));
    return true;
  }

  /// Short fits of those of `smaller`, subsets of the best set, that were not tried, each from a set with one
  /// effect more. Most are far worse than the best set, and a fit to the end would take long and change
  /// nothing.
  void shrinkTo(const std::vector<EffectSet>& smaller, const EffectSet& best) {
    std::vector<Removal> removals;
    for (const EffectSet& effects : smaller) {
      if (found_.sets.contains(effects)) continue;
      for (const EffectCandidate& effect : best) {
        const auto larger = found_.sets.find(plus(effects, effect));
        if (contains(effects, effect) || larger == found_.sets.end()) continue;
        fitter_.relinearise(larger->second);
        removals.push_back({&larger->second, effect});
        break;
      }
    }
    if (removals.empty() || ends()) return;
    report(fmt::format("Fitting without {}", removals.front().effect.hypothesis->words.title));
    std::vector<SetFit> near, others;
    for (SetFit& set : fitter_.reduced(removals))
      (fittedValue(set) > fittedValue(at(best)) - kWorthMuch ? near : others).push_back(std::move(set));
    keepThin(std::move(others));
    if (!near.empty() && !ends()) keepThin(fitter_.settled(std::move(near)));
    for (const Removal& removal : removals)
      if (removal.parent->effects != found_.best) SetFitter::thin(at(removal.parent->effects));
  }

  /// Keeps sets, thinned except the best and the empty one.
  void keepThin(std::vector<SetFit> sets) {
    for (SetFit& set : sets) {
      const EffectSet effects = set.effects;
      keep(std::move(set));
      if (!effects.empty() && effects != found_.best) SetFitter::thin(at(effects));
    }
  }

  struct Expansion {
    int refits = 0;           ///< largest number of candidates that are refitted
    std::size_t settled = 0;  ///< largest number of them that are fitted to the end
    double least = 0.0;       ///< [nats]
  };

  /// Candidates that can gain less than `least` by their score tests, or less than one more effect costs, are
  /// not refitted. A set is not expanded if no model can gain that much.
  void expand(const EffectSet& effects, const Expansion& how) {
    const auto [refits, settled, least] = how;
    if (effects.size() >= static_cast<std::size_t>(options_.most_causes)) return;
    SetFit& parent = at(effects);
    if (parent.squares.sum.size() == 0) return;  // its simulation diverged
    const double cost = found_.prior.costOfOneMore(effects.size());
    if (!effects.empty() && room(parent) < std::max(least, cost)) return;
    fitter_.relinearise(parent);
    const std::vector<EffectCandidate> candidates =
        candidatesOf(recordings_, parent.fit.model, options_.only);
    begin("Testing hypotheses");
    const std::vector<ScoreTest> tests = screen(data_, parent.fit, parent.weighting, candidates);
    std::vector<ScoreTest> promising;
    std::set<EffectSet> extended;
    for (const ScoreTest& test : tests) {
      const EffectSet with = plus(effects, {test.hypothesis, test.joint});
      if (extended.size() >= static_cast<std::size_t>(refits)) break;
      if (isSettled(with) || !canLead(parent, with, test, extended.size() < settled, least)) continue;
      promising.push_back(test);
      extended.insert(with);
    }
    if (cancelled(progress_)) return;
    if (!promising.empty())
      report(fmt::format("Refitting with {}", promising.front().hypothesis->words.title));
    std::vector<SetFit> trials = bestOfEach(fitter_.extended(parent, promising));
    if (cancelled(progress_)) return;
    if (effects.empty() || effects == found_.best)
      for (Candidate& candidate : testedCandidates(parent, tests, trials, ++round_, *score_))
        found_.tested.push_back(std::move(candidate));
    settleBest(std::move(trials), parent, promising, settled);
    if (effects.empty()) tryFromNominal(parent, candidates);
    if (!effects.empty() && effects != found_.best) SetFitter::thin(at(effects));
  }

  /// Effects that the refit hides, since the nominal parameters have moved in their place.
  void tryFromNominal(const SetFit& parent, std::vector<EffectCandidate> candidates) {
    std::erase_if(candidates, [&](const auto& effect) { return isSettled(plus(parent.effects, effect)); });
    std::vector<SetFit> trials = bestOfEach(fitter_.extendedFromNominal(parent, candidates, kFromNominal));
    sortByFit(trials);
    while (trials.size() > kRestarts) trials.pop_back();
    keepThin(fitter_.settled(std::move(trials)));
  }

  void sortByFit(std::vector<SetFit>& sets) const {
    std::ranges::stable_sort(
        sets, [&](const SetFit& a, const SetFit& b) { return fittedValue(a) > fittedValue(b); });
  }

  /// The best fit of each set: an effect can have several forms.
  std::vector<SetFit> bestOfEach(std::vector<SetFit> trials) const {
    std::vector<SetFit> best;
    for (SetFit& trial : trials) {
      const auto known = std::ranges::find(best, trial.effects, &SetFit::effects);
      if (known == best.end())
        best.push_back(std::move(trial));
      else if (fittedValue(trial) > fittedValue(*known))
        *known = std::move(trial);
    }
    return best;
  }

  /// Largest gain of any model: no misfit beyond the noise, and every parameter at its nominal value [nats].
  double room(const SetFit& set) const {
    return score_->room(set.squares) - set.fit.model.logPrior(set.fit.u);
  }

  /// Whether the recordings show much that the set does not explain. Then errors are so correlated, and laws
  /// so far from linear, that score tests and short fits say little about what an effect gains.
  bool isFar(const SetFit& set) const { return score_->excess(set.squares) > kFar; }

  /// Whether the effect of `test` can gain `least` nats and what it costs. Far from an explanation those that
  /// come `first` can.
  bool canLead(const SetFit& parent, const EffectSet& with, const ScoreTest& test, bool first,
               double least) const {
    const double most = first && isFar(parent)
                            ? room(parent)
                            : score_->mostGain(parent.squares, test.share) + kBeyondTest * test.prior;
    return most >= std::max(least, costOf(parent.effects, with));
  }

  /// Gain of a trial's fittedValue() that its score tests predict [nats].
  double predictedGain(const SetFit& parent, const EffectSet& with,
                       const std::vector<ScoreTest>& tests) const {
    double most = 0.0;
    for (const ScoreTest& test : tests)
      if (plus(parent.effects, {test.hypothesis, test.joint}) == with)
        most = std::max(most, score_->mostGain(parent.squares, test.share) / kBeyondTest + test.prior);
    return most - costOf(parent.effects, with);
  }

  /// Fall of the log prior from a set to a larger one [nats].
  double costOf(const EffectSet& effects, const EffectSet& with) const {
    return found_.prior.of(effects) - found_.prior.of(with);
  }

  /// Fits to the end the best trials that are better than the set which they extend; far from an explanation
  /// the best ones in any case. Trials that gain much less than predicted are also fitted from the nominal
  /// parameters: the parent's may have moved so far in place of the effect that no fit returns.
  void settleBest(std::vector<SetFit> trials, const SetFit& parent, const std::vector<ScoreTest>& tests,
                  std::size_t most) {
    if (trials.empty()) return;
    sortByFit(trials);
    const double before = fittedValue(parent), best = fittedValue(trials.front()) - before;
    const bool far = isFar(parent);
    std::vector<SetFit> hopeful, others, restarts;
    for (SetFit& trial : trials) {
      const double gain = fittedValue(trial) - before;
      const double predicted = predictedGain(parent, trial.effects, tests);
      const bool better = gain > 0.0 && gain >= kHopeful * best;
      const bool restart =
          restarts.size() < kRestarts && gain < kHopeful * predicted && predicted >= std::max(best, kContend);
      if (restart) restarts.push_back(SetFitter::fromNominal(trial));
      (hopeful.size() < most && (far || better || restart) ? hopeful : others).push_back(std::move(trial));
    }
    std::ranges::move(restarts, std::back_inserter(hopeful));
    keepThin(std::move(others));
    if (hopeful.empty() || cancelled(progress_)) return;
    report("Settling the candidate models");
    keepThin(fitter_.settled(std::move(hopeful)));
  }

  /// Fits the best set from the nominal parameters and from other forms of its effects, too, before sets with
  /// more effects make up for a fit in a wrong minimum. True: that has changed the best set or its fit.
  bool restartBest() {
    const EffectSet effects = found_.best;
    if (effects.empty() || restarted_.contains(effects) || ends()) return false;
    restarted_.insert(effects);
    begin("Refitting from other starts");
    fitter_.relinearise(at(effects));
    const double before = value(effects);
    std::vector<SetFit> starts{SetFitter::fromNominal(at(effects))};
    std::vector<SetFit> others = fitter_.fromOtherForms(at(effects));
    sortByFit(others);
    for (std::size_t k = 0; k < std::min(others.size(), kOtherForms); ++k)
      starts.push_back(std::move(others[k]));
    for (SetFit& set : fitter_.settled(std::move(starts))) keep(std::move(set));
    if (!(value(effects) > before + kRestart)) return found_.best != effects;
    expanded_.erase(effects);
    return true;
  }

  void finish() {
    fitter_.relinearise(at(found_.best));
    fitter_.relinearise(at({}));
    if (progress_) progress_->report(options_.progress_end, "Weighing the candidate models");
  }

  void report(const std::string& doing) { shown_.report(doing); }
  void begin(const std::string& step) { shown_.beginStep(stepsLeft()), report(step); }

  /// Steps that are known to be left: this one, expansions of the beam and of neighbours, another start.
  int stepsLeft() {
    std::vector<EffectSet> sets = ranked();
    sets.resize(std::min(sets.size(), kBeam));
    for (const EffectCandidate& effect : found_.best) sets.push_back(minus(found_.best, effect));
    const auto open = std::ranges::count_if(sets, [&](const auto& set) { return !expanded_.contains(set); });
    return 1 + static_cast<int>(open) + (restarted_.contains(found_.best) ? 0 : 1);
  }

  const FitData& data_;
  const std::vector<Evidence>& recordings_;
  const SearchOptions& options_;
  base::Progress* progress_;
  SetFitter fitter_;
  std::optional<PredictiveScore> score_;
  SearchResult found_;
  std::map<EffectSet, double> value_;
  std::set<EffectSet> expanded_, restarted_;
  int round_ = 0;
  SearchProgress shown_;
};

}  // namespace

SearchResult searchSets(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                        const Fit* start, const SearchOptions& options, base::Progress* progress) {
  return Search(data, recordings, options, progress).run(nominal, start);
}

}  // namespace capstan::diagnosis
