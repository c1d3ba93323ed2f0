#pragma once

#include <map>

#include "core/diagnosis/selection/predictive_score.h"
#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {

/// Held-out scores of the settled sets of `sets` [nats], without what only their folds' convergence makes:
///     score(S) = F(S) − min over T ⊇ S of (F(T) − H(T)),
/// F and H the scores of the residuals on fitted and on held-out blocks. F − H is the optimism of a fit
/// (Efron, The estimation of prediction error, Journal of the American Statistical Association 99, 2004). It
/// grows with the freedom of the model, so that it is at most as large as that of any model that contains
/// it. Where it seems larger, the fits without single folds have ended in worse minima.
std::map<EffectSet, double> heldOutScores(const std::map<EffectSet, SetFit>& sets,
                                          const PredictiveScore& score);

}  // namespace capstan::diagnosis
