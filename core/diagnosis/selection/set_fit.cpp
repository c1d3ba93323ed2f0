#include "core/diagnosis/selection/set_fit.h"

#include <algorithm>
#include <iterator>

#include "core/diagnosis/fit/held_out.h"

namespace capstan::diagnosis {
namespace {

constexpr int kShortIterations = 3;                       // of a fit that ranks candidates
constexpr int kShortIterationsRigid = 6;                  // of rigid drives, whose errors of force add up
constexpr double kStartShares[] = {1.0, 0.3, 0.1, 0.03};  // of the way that a score test predicts
/// Most iterations of each pass of a settled fit: of the nominal structure, whose numbers start from the
/// robot file (rigid drives take up to 44), and of sets of effects, which start from another fit.
constexpr int kFirstIterations = 60, kLastIterations = 12;
constexpr int kPasses = 3;  // of a settled fit, each with the weights of the residual before

/// Falls of the objective [nats] at which a fit stands still: while weights still change, and at the end.
constexpr double kRough = 0.3, kFine = 0.1;
double toleranceOf(int pass) { return pass == 1 ? kRough : kFine; }
constexpr double kSteady = 0.05;  // relative change of weights that no fit follows

/// Weights of a pass. Fits of rigid drives begin with weights by noise alone: their constants can be so far
/// off that one joint's residual is many times that of the others.
Eigen::VectorXd weightsOfPass(const FitData& data, const Eigen::VectorXd& e, int pass) {
  return pass == 1 && data.rigid() && data.sensors() > 1 ? noiseWeightsFor(data, e) : weightsFor(data, e);
}

/// False for a fit that was cancelled before its first linearisation, or whose simulation diverged.
bool isComplete(const SetFit& set) {
  return set.fit.jacobian.rows() == set.fit.e.size() && set.fit.e.allFinite();
}

}  // namespace

SetFit SetFitter::nominal(const FitModel& model, const Eigen::VectorXd& u) const {
  const InitialStates initial = noneBeyond(data_);
  SetFit set{{}, {.model = model}, {}};
  const Eigen::VectorXd e = linearise(data_, model, u, initial, {Eigen::VectorXd::Ones(data_.size())}).e;
  set.weighting.weights = weightsFor(data_, e);
  set.fit =
      fit(data_, model, u, initial, set.weighting, {.iterations = kFirstIterations, .tolerance = kRough});
  std::vector<SetFit> one;
  one.push_back(std::move(set));
  settle(one, kFirstIterations);
  return std::move(one.front());
}

namespace {

/// The fit with the effect of `test`, at a share of the way that the score test predicts.
FitTask startAt(const SetFit& parent, const ScoreTest& test, double share) {
  EffectStart start = test.start;
  for (std::size_t k = 0; k < start.value.size(); ++k)
    start.value[k] = test.from[k] + share * (start.value[k] - test.from[k]);
  FitModel model = parent.fit.model.with(*test.hypothesis, test.joint, start);
  Eigen::VectorXd u = model.startFrom(parent.fit.model, parent.fit.u + share * test.follow);
  return {std::move(model), std::move(u), parent.fit.initial, parent.weighting};
}

}  // namespace

std::vector<SetFit> SetFitter::extended(const SetFit& parent, const std::vector<ScoreTest>& tests) const {
  constexpr std::size_t kStarts = std::size(kStartShares);
  std::vector<FitTask> starts, tasks;
  for (const ScoreTest& test : tests)
    for (const double share : kStartShares) starts.push_back(startAt(parent, test, share));
  const std::vector<double> objectives = objectivesAt(data_, parent.fit, starts);
  std::vector<EffectSet> effects;
  for (std::size_t k = 0; k < tests.size(); ++k) {
    const auto first = objectives.begin() + static_cast<std::ptrdiff_t>(k * kStarts);
    const auto best = std::min_element(first, first + static_cast<std::ptrdiff_t>(kStarts));
    FitTask& start = starts[static_cast<std::size_t>(best - objectives.begin())];
    tasks.push_back(shortFit(parent, std::move(start.model), std::move(start.u)));
    effects.push_back(plus(parent.effects, {tests[k].hypothesis, tests[k].joint}));
  }
  return fitted(tasks, std::move(effects));
}

std::vector<SetFit> SetFitter::extendedFromNominal(const SetFit& parent,
                                                   const std::vector<EffectCandidate>& candidates,
                                                   std::size_t most) const {
  SetFit nominal = fromNominal(parent);
  nominal.fit = linearise(data_, nominal.fit.model, nominal.fit.u, nominal.fit.initial, nominal.weighting);
  const Weighting own{weightsFor(data_, nominal.fit.e)};  // of the residual there, which is far larger
  std::vector<ScoreTest> tests = screen(data_, nominal.fit, own, candidates);
  if (tests.size() > most) tests.erase(tests.begin() + static_cast<std::ptrdiff_t>(most), tests.end());
  return extended(nominal, tests);
}

SetFit SetFitter::extended(const SetFit& parent, const EffectSet& effects, const Fit& from) const {
  FitModel model = parent.fit.model;
  EffectSet all = parent.effects;
  for (const EffectTerm& term : from.model.effects()) {
    const EffectCandidate effect{term.hypothesis, term.joint};
    if (term.background || !contains(effects, effect)) continue;
    model = model.with(*term.hypothesis, term.joint, term.start);
    all = plus(std::move(all), effect);
  }
  return fitted({shortFit(parent, model, model.carry(from.model, from.u))}, {all}).front();
}

std::vector<SetFit> SetFitter::reduced(const std::vector<Removal>& removals) const {
  std::vector<FitTask> tasks;
  std::vector<EffectSet> effects;
  for (const auto& [parent, effect] : removals) {
    const FitModel model = parent->fit.model.without(*effect.hypothesis, effect.joint);
    tasks.push_back(shortFit(*parent, model, model.carry(parent->fit.model, parent->fit.u)));
    effects.push_back(minus(parent->effects, effect));
  }
  return fitted(tasks, std::move(effects));
}

namespace {

/// Whether two starts differ in the effect's size alone: in fitted numbers that are the first one or have the
/// neutral value 0.
bool haveOneForm(const Hypothesis& hypothesis, const EffectStart& a, const EffectStart& b) {
  for (std::size_t k = 0; k < a.value.size(); ++k) {
    const bool is_fixed = a.scale[k] == 0.0 && b.scale[k] == 0.0;
    const bool is_shape = k > 0 && hypothesis.neutral[k] != 0.0;
    if ((is_fixed || is_shape) && a.value[k] != b.value[k]) return false;
  }
  return true;
}

/// Starts of the effect of `term` in other forms. Score tests have changed its size.
std::vector<EffectStart> otherForms(const EffectTerm& term, const JointScales& scales) {
  if (std::ranges::any_of(term.hypothesis->facts->parameters, isEventTime)) return {};
  std::vector<EffectStart> others = term.hypothesis->starts(scales, term.joint);
  std::erase_if(others,
                [&](const EffectStart& start) { return haveOneForm(*term.hypothesis, start, term.start); });
  return others;
}

}  // namespace

std::vector<SetFit> SetFitter::fromOtherForms(const SetFit& set) const {
  std::vector<FitTask> tasks;
  for (const EffectTerm& term : set.fit.model.effects()) {
    if (term.background) continue;
    const FitModel without = set.fit.model.without(*term.hypothesis, term.joint);
    const Eigen::VectorXd u = without.carry(set.fit.model, set.fit.u);
    for (const EffectStart& start : otherForms(term, scalesOf(without.scales(), term.joint))) {
      const FitModel model = without.with(*term.hypothesis, term.joint, start);
      tasks.push_back(shortFit(set, model, model.startFrom(without, u)));
    }
  }
  return fitted(tasks, std::vector<EffectSet>(tasks.size(), set.effects));
}

FitTask SetFitter::shortFit(const SetFit& parent, FitModel model, Eigen::VectorXd u) const {
  FitTask task{std::move(model), std::move(u), parent.fit.initial, parent.weighting};
  task.options = {.iterations = data_.rigid() ? kShortIterationsRigid : kShortIterations,
                  .tolerance = kRough};
  if (!data_.rigid()) task.options.known = &parent.fit, task.options.coarse = true;
  return task;
}

std::vector<SetFit> SetFitter::fitted(const std::vector<FitTask>& tasks,
                                      std::vector<EffectSet> effects) const {
  std::vector<Fit> fits = fitAll(data_, tasks);
  std::vector<SetFit> sets;
  for (std::size_t k = 0; k < tasks.size(); ++k)
    sets.push_back({std::move(effects[k]), std::move(fits[k]), tasks[k].weighting});
  for (SetFit& set : sets)
    if (isComplete(set)) set.fitted = set.squares = squaresOf(data_, set.fit.e);
  return sets;
}

namespace {

/// Whether weights have changed so little that a fit with the new ones would be the same.
bool areSteady(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  return before.size() == after.size() && (after.array() / before.array() - 1.0).abs().maxCoeff() < kSteady;
}

}  // namespace

std::vector<SetFit> SetFitter::settled(std::vector<SetFit> sets) const {
  settle(sets, kLastIterations);
  return sets;
}

void SetFitter::settle(std::vector<SetFit>& sets, int iterations) const {
  std::vector<SetFit*> moving;
  for (SetFit& set : sets) moving.push_back(&set);
  for (int pass = 1; pass <= kPasses && !moving.empty() && !data_.cancelled(); ++pass) {
    std::vector<FitTask> tasks;
    std::vector<SetFit*> fitted;
    for (SetFit* set : moving) {
      Eigen::VectorXd weights = weightsOfPass(data_, set->fit.e, pass);
      if (pass > 1 && areSteady(set->weighting.weights, weights)) continue;
      set->weighting.weights = std::move(weights);
      FitTask task{set->fit.model, set->fit.u, set->fit.initial, set->weighting};
      task.options = {.iterations = iterations, .tolerance = toleranceOf(pass)};
      if (!data_.rigid() && set->fit.jacobian.size() > 0) task.options.begun = &set->fit;
      tasks.push_back(std::move(task));
      fitted.push_back(set);
    }
    std::vector<Fit> fits = fitAll(data_, tasks);
    for (std::size_t k = 0; k < fitted.size(); ++k) fitted[k]->fit = std::move(fits[k]);
    moving = std::move(fitted);
  }
  holdOut(sets);
  for (SetFit& set : sets) set.settled = set.effects.empty() || !data_.cancelled();
}

SetFit SetFitter::settled(SetFit set) const {
  std::vector<SetFit> one;
  one.push_back(std::move(set));
  return std::move(settled(std::move(one)).front());
}

SetFit SetFitter::fromNominal(const SetFit& like) {
  SetFit set{like.effects, {.model = like.fit.model, .u = like.fit.u}, like.weighting};
  set.fit.u.head(like.fit.model.baseSize()).setZero();
  set.fit.initial = like.fit.initial;
  set.fit.e = like.fit.e;  // for the first weights
  return set;
}

void SetFitter::relinearise(SetFit& set) const {
  if (set.fit.jacobian.size() > 0) return;
  const std::vector<bool> bound = set.fit.bound;
  set.fit = linearise(data_, set.fit.model, set.fit.u, set.fit.initial, set.weighting);
  set.fit.bound = bound;
}

void SetFitter::thin(SetFit& set) {
  set.fit.jacobian.resize(0, 0);
  set.fit.nuisance.resize(0, 0);
  set.fit.removed.clear();
  set.fit.e.resize(0);
}

void SetFitter::holdOut(std::vector<SetFit>& sets) const {
  std::vector<SetFit*> finite;
  std::vector<WeightedFit> fits;
  for (SetFit& set : sets) {
    set.fitted = set.squares = {};
    if (!isComplete(set)) continue;
    set.fitted = squaresOf(data_, set.fit.e);
    finite.push_back(&set);
    fits.push_back({&set.fit, &set.weighting});
  }
  const std::vector<Eigen::VectorXd> residuals = heldOut(data_, fits);
  for (std::size_t k = 0; k < finite.size(); ++k) finite[k]->squares = squaresOf(data_, residuals[k]);
}

}  // namespace capstan::diagnosis
