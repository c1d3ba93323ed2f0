#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Held-out residuals by cross-validation with the folds of FitData::fold(). For each fold f the fit is
/// continued from its estimate with a tenth of the weight of f. The tenth limits the influence of events that
/// a single fold contains, such as the position within the play at the start. Steps are chord Gauss–Newton,
///     Δu = (A − 0.9 J_fᵀ J_f)⁻¹ (J_oᵀ e_o + 0.1 J_fᵀ e_f − P u − g),   A = Jᵀ J + P,
/// with the fit's Jacobian J, its rows J_o of the other folds and J_f of f, the priors P, and g = Jᵀ e − P u
/// of the full fit, which is not zero if the fit stopped before a minimum. Each step is tried in full,
/// shorter, and with ridges (Levenberg–Marquardt), of at most kLongestWay in any u and within the bounds. A
/// simulation decides whether it is accepted. The residuals of fold f are those of the last accepted
/// simulation, with the initial states of rigid drives adapted. Nuisances are fitted to held-out segments
/// too. Parameters at a bound stay there; so do times of single events, because one block alone determines
/// them.
Eigen::VectorXd heldOut(const FitData& data, const Fit& fit, const Weighting& weighting);
/// The same of several fits, whose robots are simulated in parallel.
std::vector<Eigen::VectorXd> heldOut(const FitData& data, const std::vector<WeightedFit>& fits);
inline constexpr double kLongestWay = 1.0;  ///< largest change of any u in one step without a fold

}  // namespace capstan::diagnosis
