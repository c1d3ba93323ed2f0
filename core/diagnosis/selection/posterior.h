#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/effect_set.h"
#include "core/diagnosis/selection/predictive_score.h"

/// Selection of one among the candidate models of some recordings. It needs the models' effects, priors and
/// held-out residuals only; recordings of joints and tables of tip poses use the same functions.
namespace capstan::diagnosis {

/// Candidate model that was fitted until convergence.
template <class Effect>
struct CandidateModel {
  SetOf<Effect> effects;
  const BlockSquares* squares = nullptr;  ///< held-out residuals
  double log_prior = 0.0;                 ///< of the effects and their sizes [nats]
  double correction = 0.0;                ///< added to the score of `squares`: heldOutScores() [nats]
};

/// Effect of the selected set.
template <class Effect>
struct SelectedOf {
  Effect effect;
  double probability = 0.0;  ///< sum of the posterior over all sets with the effect
  double loss = 0.0;         ///< held-out score lost without this effect alone [nats]
  BlockSquares without;      ///< held-out residuals of the selected set without the effect
};

/// Effects that explain the recordings about as well in the place of a selected one.
template <class Effect>
struct CompetitorsOf {
  Effect selected;
  std::vector<Effect> others;
  /// Relative probabilities: of the selected effect, then of each of `others`, in models with one of them.
  std::vector<double> probabilities;
};

/// Effect of the most probable set that is not selected, because the set without it is probable enough
/// (kMinOddsWithout).
template <class Effect>
struct UncertainOf {
  Effect effect;
  double probability = 0.0;  ///< that the effect is in the model
};

/// Log prior of a set of `effects` out of `candidates` [nats]: all sets of one size are equally probable, and
/// each further effect multiplies the probability of the size by kEffectOdds.
double logPrior(std::size_t effects, int candidates);
inline constexpr double kEffectOdds = 0.25;
inline constexpr int kDraws = 400;  ///< number of block bootstraps

/// Smallest ratio of the probability of a reported set to that of the best set (Occam's window, Madigan and
/// Raftery 1994).
inline constexpr double kOccam = 1e-3;
/// Smallest Exchange::replaces at which an effect makes a tie with a selected one, as a share of the
/// probability of all models with exactly one of the two.
inline constexpr double kTie = 0.2;
/// An effect is not selected if the probability of the set without it is at least this multiple of that of
/// the most probable set: at odds of less than 2 to 1 the recordings do not decide.
inline constexpr double kMinOddsWithout = 0.5;

/// Posterior probability of each model, averaged over block bootstraps (bagged posterior, Huggins and Miller
/// 2023), because none of the models is exactly right:
///     p(S) = mean over draws d of  exp(L_d(S)) π(S) / Σ_S' exp(L_d(S')) π(S').
/// `log_scores`: L_d + ln π [nats], models × draws.
Eigen::VectorXd baggedPosterior(const Eigen::MatrixXd& log_scores);

/// Posterior of the candidate models, the most probable first.
template <class Effect>
class Posterior {
 public:
  Posterior(const std::vector<CandidateModel<Effect>>& models, const PredictiveScore& score) {
    for (const CandidateModel<Effect>& model : models)
      if (std::isfinite(score.of(*model.squares))) models_.push_back(model);
    if (models_.empty()) return;
    Eigen::MatrixXd log(static_cast<Eigen::Index>(models_.size()), kDraws);
    for (Eigen::Index k = 0; k < log.rows(); ++k) {
      const CandidateModel<Effect>& model = models_[static_cast<std::size_t>(k)];
      log.row(k) = score.ofDraws(*model.squares).transpose().array() + model.correction + model.log_prior;
    }
    const Eigen::VectorXd probability = baggedPosterior(log);
    std::vector<std::size_t> order(models_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto of = [&](std::size_t k) { return probability[static_cast<Eigen::Index>(k)]; };
    std::ranges::stable_sort(order, std::greater<>(), of);
    const std::vector<CandidateModel<Effect>> unsorted = models_;
    for (std::size_t k = 0; k < order.size(); ++k) {
      models_[k] = unsorted[order[k]];
      probability_.push_back(of(order[k]));
    }
  }

  const std::vector<CandidateModel<Effect>>& models() const { return models_; }
  double probability(std::size_t model) const { return probability_[model]; }

  double of(const SetOf<Effect>& effects) const {
    for (std::size_t k = 0; k < models_.size(); ++k)
      if (models_[k].effects == effects) return probability_[k];
    return 0.0;
  }

  /// Probability that the model has the effect.
  double inclusion(const Effect& effect) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < models_.size(); ++k)
      if (contains(models_[k].effects, effect)) sum += probability_[k];
    return sum;
  }

 private:
  std::vector<CandidateModel<Effect>> models_;
  std::vector<double> probability_;
};

/// Sets within kOccam.
template <class Effect>
std::vector<SetProbability> windowOf(const Posterior<Effect>& posterior) {
  std::vector<SetProbability> sets;
  for (std::size_t k = 0; k < posterior.models().size(); ++k) {
    if (posterior.probability(k) < kOccam * posterior.probability(0)) break;
    sets.push_back({{}, posterior.probability(k)});
    for (const Effect& effect : posterior.models()[k].effects)
      sets.back().effects.push_back({std::string(effect.name()), effect.joint});
  }
  return sets;
}

/// The simplest of the sets between which the recordings do not decide: `effects` without its uncertain
/// effects (kMinOddsWithout).
template <class Effect>
SetOf<Effect> simplest(SetOf<Effect> effects, const Posterior<Effect>& posterior) {
  const double least = kMinOddsWithout * posterior.of(effects);
  for (bool simpler = true; simpler;) {
    simpler = false;
    const SetOf<Effect> from = effects;
    double most = least;
    for (const Effect& effect : from) {
      const SetOf<Effect> less = withoutEffect(from, effect);
      const double p = posterior.of(less);
      if (!(p > most)) continue;
      most = p;
      effects = less;
      simpler = true;
    }
  }
  return effects;
}

/// Best score among the models with a subset of `effects`: a refit with one effect less may end in a worse
/// minimum than one with two less.
template <class Effect>
const CandidateModel<Effect>& bestWithin(const SetOf<Effect>& effects,
                                         const std::vector<CandidateModel<Effect>>& models,
                                         const PredictiveScore& score) {
  const CandidateModel<Effect>* best = nullptr;
  for (const CandidateModel<Effect>& model : models)
    if (std::ranges::includes(effects, model.effects) &&
        (!best || score.of(*model.squares) > score.of(*best->squares)))
      best = &model;
  return *best;
}

/// Effects of the selected set, those with the largest loss first. `models`: at least the model without
/// effects.
template <class Effect>
std::vector<SelectedOf<Effect>> selectedOf(const SetOf<Effect>& selected, const BlockSquares& squares,
                                           const std::vector<CandidateModel<Effect>>& models,
                                           const Posterior<Effect>& posterior, const PredictiveScore& score) {
  std::vector<SelectedOf<Effect>> effects;
  for (const Effect& effect : selected) {
    const BlockSquares& without = *bestWithin(withoutEffect(selected, effect), models, score).squares;
    effects.push_back({effect, posterior.inclusion(effect), score.of(squares) - score.of(without), without});
  }
  std::ranges::stable_sort(effects, std::greater<>(), &SelectedOf<Effect>::loss);
  return effects;
}

/// Effects of the most probable set that are not selected.
template <class Effect>
std::vector<UncertainOf<Effect>> uncertainOf(const SetOf<Effect>& most_probable,
                                             const SetOf<Effect>& selected,
                                             const Posterior<Effect>& posterior) {
  std::vector<UncertainOf<Effect>> uncertain;
  for (const Effect& effect : most_probable)
    if (!contains(selected, effect)) uncertain.push_back({effect, posterior.inclusion(effect)});
  return uncertain;
}

/// Probabilities of models with exactly one of two effects.
struct Exchange {
  double selected = 0.0, other = 0.0;  ///< of all models with it and without the other
  /// Of the models with `other` that remain in the posterior with `selected` in its place, and become less
  /// probable without either.
  double replaces = 0.0;
  /// Whether the recordings do not decide between the two, whatever else the model has.
  bool isTie() const { return replaces > 0.0 && replaces >= kTie * (selected + other); }
};

template <class Effect>
Exchange exchangeOf(const Posterior<Effect>& posterior, const Effect& selected, const Effect& other) {
  Exchange exchange;
  for (std::size_t k = 0; k < posterior.models().size(); ++k) {
    const SetOf<Effect>& effects = posterior.models()[k].effects;
    const double p = posterior.probability(k);
    if (contains(effects, selected) == contains(effects, other)) continue;
    if (contains(effects, selected)) {
      exchange.selected += p;
      continue;
    }
    exchange.other += p;
    const SetOf<Effect> neither = withoutEffect(effects, other);
    if (posterior.of(plus(neither, selected)) > 0.0 && posterior.of(neither) < p) exchange.replaces += p;
  }
  return exchange;
}

/// Probability of the models with `effect` and no other of the competing effects.
template <class Effect>
double aloneOf(const Posterior<Effect>& posterior, const Effect& effect,
               const CompetitorsOf<Effect>& competing) {
  double sum = 0.0;
  for (std::size_t k = 0; k < posterior.models().size(); ++k) {
    const SetOf<Effect>& effects = posterior.models()[k].effects;
    const auto is_there = [&](const Effect& one) { return contains(effects, one); };
    const auto count = std::ranges::count_if(competing.others, is_there) + is_there(competing.selected);
    if (count == 1 && is_there(effect)) sum += posterior.probability(k);
  }
  return sum;
}

/// Effects with competitors, in the order of `effects`, those of the set `selected`.
template <class Effect>
std::vector<CompetitorsOf<Effect>> competitorsOf(const SetOf<Effect>& selected,
                                                 const std::vector<SelectedOf<Effect>>& effects,
                                                 const Posterior<Effect>& posterior) {
  SetOf<Effect> others;
  for (const CandidateModel<Effect>& model : posterior.models())
    for (const Effect& effect : model.effects)
      if (!contains(selected, effect)) others = plus(std::move(others), effect);
  std::vector<CompetitorsOf<Effect>> all;
  for (const SelectedOf<Effect>& one : effects) {
    CompetitorsOf<Effect> competing{one.effect, {}, {}};
    for (const Effect& other : others)
      if (exchangeOf(posterior, one.effect, other).isTie()) competing.others.push_back(other);
    if (competing.others.empty()) continue;
    const auto probability = [&](const Effect& effect) { return aloneOf(posterior, effect, competing); };
    std::ranges::stable_sort(competing.others, std::greater<>(), probability);
    competing.probabilities.push_back(probability(one.effect));
    for (const Effect& other : competing.others) competing.probabilities.push_back(probability(other));
    const double sum = std::accumulate(competing.probabilities.begin(), competing.probabilities.end(), 0.0);
    for (double& p : competing.probabilities) p /= sum;
    all.push_back(std::move(competing));
  }
  return all;
}

}  // namespace capstan::diagnosis
