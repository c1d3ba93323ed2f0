#pragma once

#include "core/base/progress.h"
#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/selection/effect_set.h"
#include "core/diagnosis/selection/screening.h"

namespace capstan::diagnosis {

/// A candidate model: a set of effects, fitted, with its residuals on held-out blocks.
struct SetFit {
  EffectSet effects;
  Fit fit;
  Weighting weighting;
  BlockSquares squares = {};
  bool settled = false;  ///< false: after a short fit with the weights of the model that it started from
};

/// Fits sets of effects to one robot's recordings. Each fit starts from another set's fit.
class SetFitter {
 public:
  SetFitter(const FitData& data, const base::Progress* progress) : data_(data), progress_(progress) {}

  /// The nominal structure, fitted from `u` (of `model`) to the end.
  SetFit nominal(const FitModel& model, const Eigen::VectorXd& u) const;
  /// `parent` and one more effect, from where the score test suggests; a short fit.
  SetFit extended(const SetFit& parent, const ScoreTest& test) const;
  /// `parent` and several effects that `from` has, from its numbers; a short fit.
  SetFit extended(const SetFit& parent, const EffectSet& effects, const Fit& from) const;
  /// `parent` without one of its effects; a short fit.
  SetFit reduced(const SetFit& parent, const EffectCandidate& effect) const;
  /// The same set fitted to the end: the weights follow the residual.
  SetFit settled(SetFit from) const;
  /// The same set fitted to the end, with the nominal structure's numbers started from the nominal robot: a fit without an
  /// effect bends them to replace it, at times too far to find back.
  SetFit settledFromNominal(const SetFit& like) const;
  /// The linearisation that thin() dropped.
  void relinearise(SetFit& set) const;
  /// Drops what can be computed again: Jacobians of all models that were tried would fill the memory.
  static void thin(SetFit& set);

 private:
  SetFit shortFit(const SetFit& parent, EffectSet effects, const FitModel& model, const Eigen::VectorXd& u) const;
  void holdOut(SetFit& set) const;

  const FitData& data_;
  const base::Progress* progress_;
};

}  // namespace capstan::diagnosis
