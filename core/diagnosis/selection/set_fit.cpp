#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {
namespace {

constexpr int kShortIterations = 3;       // of a fit that ranks candidates
constexpr int kShortIterationsRigid = 6;  // of rigid drives, whose errors of force add up
constexpr int kFirstIterations = 20;      // of the nominal structure, whose numbers start from the robot file
constexpr int kLastIterations = 12;       // of each pass of a settled fit
constexpr int kPasses = 3;                // of a settled fit, each with the weights of the residual before

/// Falls of the objective [nats] at which a fit stands still: of rigid drives, whose initial states creep,
/// while weights still change; and at the end.
constexpr double kRough = 0.1, kFine = 0.05;
double toleranceOf(const FitData& data, int pass) { return data.rigid() && pass < kPasses ? kRough : kFine; }

}  // namespace

SetFit SetFitter::nominal(const FitModel& model, const Eigen::VectorXd& u) const {
  const InitialStates initial = noneBeyond(data_);
  SetFit set{{}, {.model = model}, {}};
  set.weighting.weights =
      weightsFor(data_, linearise(data_, model, u, initial, {Eigen::VectorXd::Ones(data_.size())}).e);
  set.fit = fit(data_, model, u, initial, set.weighting,
                {.iterations = kFirstIterations, .tolerance = toleranceOf(data_, 0)});
  return settled(std::move(set));
}

std::vector<SetFit> SetFitter::extended(const SetFit& parent, const std::vector<ScoreTest>& tests) const {
  std::vector<FitTask> tasks;
  std::vector<EffectSet> effects;
  for (const ScoreTest& test : tests) {
    const FitModel model = parent.fit.model.with(*test.hypothesis, test.joint, test.start);
    tasks.push_back(shortFit(parent, model, model.startFrom(parent.fit.model, parent.fit.u)));
    effects.push_back(plus(parent.effects, {test.hypothesis, test.joint}));
  }
  return fitted(tasks, std::move(effects));
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
  if (data_.rigid()) {
    holdOut(sets);
    return sets;
  }
  for (SetFit& set : sets)
    if (set.fit.e.allFinite()) set.squares = squaresOf(data_, linearHeldOut(data_, set.fit, set.weighting));
  return sets;
}

std::vector<SetFit> SetFitter::settled(std::vector<SetFit> sets) const {
  for (int pass = 1; pass <= kPasses && !data_.cancelled(); ++pass) {
    std::vector<FitTask> tasks;
    for (SetFit& set : sets) {
      set.weighting.weights = weightsFor(data_, set.fit.e);
      FitTask task{set.fit.model, set.fit.u, set.fit.initial, set.weighting};
      task.options = {.iterations = kLastIterations, .tolerance = toleranceOf(data_, pass)};
      if (!data_.rigid() && pass > 1) task.options.begun = &set.fit;
      tasks.push_back(std::move(task));
    }
    std::vector<Fit> fits = fitAll(data_, tasks);
    for (std::size_t k = 0; k < sets.size(); ++k) sets[k].fit = std::move(fits[k]);
  }
  holdOut(sets);
  for (SetFit& set : sets) set.settled = set.effects.empty() || !data_.cancelled();
  return sets;
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
    set.squares = {};
    const bool begun = set.fit.jacobian.rows() == set.fit.e.size();  // not if cancelled before
    if (!begun || !set.fit.e.allFinite()) continue;
    finite.push_back(&set);
    fits.push_back({&set.fit, &set.weighting});
  }
  const std::vector<Eigen::VectorXd> residuals = heldOut(data_, fits);
  for (std::size_t k = 0; k < finite.size(); ++k) finite[k]->squares = squaresOf(data_, residuals[k]);
}

}  // namespace capstan::diagnosis
