#pragma once

#include "core/base/progress.h"
#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/selection/effect_set.h"
#include "core/diagnosis/selection/screening.h"

namespace capstan::diagnosis {

/// Fit of one candidate model (a set of effects), and its residuals on held-out blocks.
struct SetFit {
  EffectSet effects;
  Fit fit;
  Weighting weighting;
  BlockSquares squares = {};
  /// True: fitted until convergence. False: a short fit with the weights of the model that it started from.
  bool settled = false;
};

/// Fits sets of effects to the recordings of one robot. Each fit starts from the fit of another set.
class SetFitter {
 public:
  SetFitter(const FitData& data, const base::Progress* progress) : data_(data), progress_(progress) {}

  /// Fit of `model`, the nominal robot without effects, from `u` until convergence.
  SetFit nominal(const FitModel& model, const Eigen::VectorXd& u) const;
  /// Short fit of `parent` with one more effect, which starts as the score test predicts.
  SetFit extended(const SetFit& parent, const ScoreTest& test) const;
  /// Short fit of `parent` with several effects of `from`, which start from the parameters of `from`.
  SetFit extended(const SetFit& parent, const EffectSet& effects, const Fit& from) const;
  /// Short fit of `parent` without one of its effects.
  SetFit reduced(const SetFit& parent, const EffectCandidate& effect) const;
  /// The same set, fitted until convergence; the weights are computed again from the residual.
  SetFit settled(SetFit from) const;
  /// The same set, fitted until convergence; the parameters of the nominal robot start from their nominal
  /// values. A fit without an effect changes these parameters to replace the effect, sometimes so far that a
  /// fit with the effect does not return from there.
  SetFit settledFromNominal(const SetFit& like) const;
  /// Computes the linearisation again that thin() deleted.
  void relinearise(SetFit& set) const;
  /// Deletes what can be computed again, because the Jacobians of all tried models would fill the memory.
  static void thin(SetFit& set);

 private:
  SetFit shortFit(const SetFit& parent, EffectSet effects, const FitModel& model,
                  const Eigen::VectorXd& u) const;
  void holdOut(SetFit& set) const;

  const FitData& data_;
  const base::Progress* progress_;
};

}  // namespace capstan::diagnosis
