#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {
namespace {

constexpr int kShortIterations = 3;       // of a fit that ranks candidates
constexpr int kShortIterationsRigid = 6;  // of rigid drives, whose errors of force add up
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
  set.fit = fit(data_, model, u, initial, set.weighting, {20, toleranceOf(data_, 0), nullptr}, progress_);
  return settled(std::move(set));
}

SetFit SetFitter::extended(const SetFit& parent, const ScoreTest& test) const {
  const FitModel model = parent.fit.model.with(*test.hypothesis, test.joint, test.start);
  return shortFit(parent, plus(parent.effects, {test.hypothesis, test.joint}), model,
                  model.startFrom(parent.fit.model, parent.fit.u));
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
  return shortFit(parent, std::move(all), model, model.carry(from.model, from.u));
}

SetFit SetFitter::reduced(const SetFit& parent, const EffectCandidate& effect) const {
  const FitModel model = parent.fit.model.without(*effect.hypothesis, effect.joint);
  return shortFit(parent, minus(parent.effects, effect), model, model.carry(parent.fit.model, parent.fit.u));
}

SetFit SetFitter::shortFit(const SetFit& parent, EffectSet effects, const FitModel& model,
                           const Eigen::VectorXd& u) const {
  const FitOptions options = data_.rigid() ? FitOptions{kShortIterationsRigid, kRough, nullptr}
                                           : FitOptions{kShortIterations, kRough, &parent.fit};
  SetFit set{std::move(effects),
             fit(data_, model, u, parent.fit.initial, parent.weighting, options, progress_),
             parent.weighting};
  holdOut(set);
  return set;
}

SetFit SetFitter::settled(SetFit set) const {
  for (int pass = 1; pass <= kPasses; ++pass) {
    set.weighting.weights = weightsFor(data_, set.fit.e);
    if (progress_ && progress_->cancelled()) break;
    set.fit = fit(data_, set.fit.model, set.fit.u, set.fit.initial, set.weighting,
                  {kLastIterations, toleranceOf(data_, pass), nullptr}, progress_);
  }
  holdOut(set);
  set.settled = true;
  return set;
}

SetFit SetFitter::settledFromNominal(const SetFit& like) const {
  Eigen::VectorXd fresh = like.fit.u;
  fresh.head(like.fit.model.baseSize()).setZero();
  SetFit set{like.effects, linearise(data_, like.fit.model, fresh, like.fit.initial, like.weighting),
             like.weighting};
  return settled(std::move(set));
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

void SetFitter::holdOut(SetFit& set) const {
  if (set.fit.e.allFinite())
    set.squares = squaresOf(data_, heldOut(data_, set.fit, set.weighting));
  else
    set.squares = {};
}

}  // namespace capstan::diagnosis
