#pragma once

#include <vector>

#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/selection/effect_set.h"
#include "core/diagnosis/selection/screening.h"

namespace capstan::diagnosis {

/// Fit of one candidate model (a set of effects), and its residuals.
struct SetFit {
  EffectSet effects;
  Fit fit;
  Weighting weighting;
  BlockSquares fitted = {};  ///< of the fit's residuals
  /// Of the residuals on held-out blocks. Short fits are not held out, because their residuals
  /// there depend on how far the fit has converged more than on the effects: `squares` equals `fitted`.
  BlockSquares squares = {};
  /// True: fitted until convergence. False: a short fit with the weights of the model that it started from.
  bool settled = false;
};

/// One effect to remove from a set.
struct Removal {
  const SetFit* parent = nullptr;
  EffectCandidate effect;
};

/// Fits sets of effects to the recordings of one robot. Each fit starts from the fit of another set. Fits
/// that one call makes proceed together (fitAll()).
class SetFitter {
 public:
  explicit SetFitter(const FitData& data) : data_(data) {}

  /// Fit of `model`, the nominal robot without effects, from `u` until convergence.
  SetFit nominal(const FitModel& model, const Eigen::VectorXd& u) const;
  /// Short fits of `parent` with one more effect each, which starts as the score test predicts.
  std::vector<SetFit> extended(const SetFit& parent, const std::vector<ScoreTest>& tests) const;
  /// The same from the nominal values of the nominal robot's parameters, where the `most` of `candidates` are
  /// chosen by their score tests: a refit may have moved these parameters in place of an effect.
  std::vector<SetFit> extendedFromNominal(const SetFit& parent,
                                          const std::vector<EffectCandidate>& candidates,
                                          std::size_t most) const;
  /// Short fit of `parent` with several effects of `from`, which start from the parameters of `from`.
  SetFit extended(const SetFit& parent, const EffectSet& effects, const Fit& from) const;
  /// Short fits of sets without one of their effects each.
  std::vector<SetFit> reduced(const std::vector<Removal>& removals) const;
  /// Short fits of the same set, each from a start of one of its effects (Hypothesis::starts()) whose form
  /// differs from that of the fit's own start: another speed, period, time constant or kind, because the fit
  /// can have a minimum beside each. Effects that happen once are left out: score tests try their times.
  std::vector<SetFit> fromOtherForms(const SetFit& set) const;
  /// The same sets, fitted until convergence; the weights are computed again from the residuals.
  std::vector<SetFit> settled(std::vector<SetFit> from) const;
  SetFit settled(SetFit from) const;
  /// Start of another fit of the same set: the parameters of the nominal robot have their nominal values. A
  /// fit without an effect changes these parameters to replace the effect, sometimes so far that a fit with
  /// the effect does not return from there.
  static SetFit fromNominal(const SetFit& like);
  /// Computes the linearisation again that thin() deleted.
  void relinearise(SetFit& set) const;
  /// Deletes what can be computed again, because the Jacobians of all tried models would fill the memory.
  static void thin(SetFit& set);

 private:
  FitTask shortFit(const SetFit& parent, FitModel model, Eigen::VectorXd u) const;
  std::vector<SetFit> fitted(const std::vector<FitTask>& tasks, std::vector<EffectSet> effects) const;
  void settle(std::vector<SetFit>& sets, int iterations) const;
  void holdOut(std::vector<SetFit>& sets) const;

  const FitData& data_;
};

}  // namespace capstan::diagnosis
