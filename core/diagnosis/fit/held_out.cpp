#include "core/diagnosis/fit/held_out.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "core/diagnosis/fit/free_system.h"
#include "core/diagnosis/fit/linear_system.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How each step is tried. A ridge, added to the normal equations, holds what the data hardly determine,
/// where laws with corners are the least linear.
struct FoldAttempt {
  double length, ridge;
};
constexpr FoldAttempt kFoldAttempts[] = {{1.0, 0.0}, {0.3, 0.0}, {1.0, 3.0}, {1.0, 100.0}};
constexpr double kOwnWeight = 0.1;    // weight of a fold in its own fit
constexpr double kShorter = 0.1;      // factor of lengths and of 1 / ridge after a step that was too long
constexpr double kLeastReach = 5e-3;  // three steps that were too long
constexpr int kMostSteps = 10;        // of each fold
constexpr double kStands = 0.05;      // fall of the objective [nats] at which a fold's fit stands still

/// A fit as it goes on without each of its folds.
class FoldFits {
 public:
  FoldFits(const FitData& data, const Fit& fit, const Weighting& weighting)
      : data_(data), fit_(fit), weighting_(weighting), system_(data, fit, weighting, true) {
    precision_ = priorPrecision(fit.model)(system_.free);
    descent_ = system_.jacobian.transpose() * system_.e - precision_.cwiseProduct(fit.u(system_.free));
    for (int f = 0; f < data.folds(); ++f) {
      Fold fold{.weight = VectorXd::Ones(data.size()), .normal = {}, .u = fit.u, .e = fit.e};
      MatrixXd normal = system_.normal;
      for (int b = 0; b < data.blocks(); ++b) {
        if (data.fold(b) != f) continue;
        const std::vector<Index>& rows = system_.rows[static_cast<std::size_t>(b)];
        const MatrixXd part = system_.jacobian(rows, Eigen::all);
        normal -= (1.0 - kOwnWeight) * part.transpose() * part;
        fold.weight(rows).setConstant(kOwnWeight);
      }
      fold.normal = std::move(normal);
      fold.objective = objective(fold, fold.u, fold.e);
      folds_.push_back(std::move(fold));
    }
  }

  /// Next trials of the folds that still move.
  std::vector<VectorXd> trials() {
    tried_.clear();
    std::vector<VectorXd> trials;
    for (Fold& fold : folds_) {
      if (fold.stands) continue;
      const VectorXd descent = descentOf(fold);
      for (const FoldAttempt& attempt : kFoldAttempts) {
        const double length = attempt.ridge > 0.0 ? attempt.length : fold.reach * attempt.length;
        const VectorXd step = stepOf(fold, descent, attempt.ridge / fold.reach);
        VectorXd u = fold.u;
        for (std::size_t k = 0; k < system_.free.size(); ++k)
          u[system_.free[k]] += length * step[static_cast<Index>(k)];
        trials.push_back(fit_.model.clipped(u));
        tried_.push_back(&fold);
      }
    }
    return trials;
  }

  /// Takes the better ones of the trials, whose residuals are the columns of `e`.
  void take(const std::vector<VectorXd>& trials, const MatrixXd& e) {
    constexpr std::size_t kOfAFold = std::size(kFoldAttempts);
    for (std::size_t k = 0; k < trials.size(); k += kOfAFold) {
      Fold& fold = *tried_[k];
      const double before = fold.objective;
      for (std::size_t i = k; i < k + kOfAFold; ++i) {
        const double reached = objective(fold, trials[i], e.col(static_cast<Index>(i)));
        if (!(reached < fold.objective)) continue;
        fold.objective = reached;
        fold.u = trials[i];
        fold.e = e.col(static_cast<Index>(i));
      }
      const double fall = before - fold.objective;
      if (!(fall > 0.0)) fold.reach *= kShorter;
      fold.stands = fall > 0.0 ? fall <= kStands : fold.reach < kLeastReach;
    }
  }

  /// Of each reading, the residual without its own fold.
  VectorXd heldOut() const {
    VectorXd left(data_.size());
    for (Index i = 0; i < left.size(); ++i) {
      const int fold = data_.fold(data_.block()[static_cast<std::size_t>(i)]);
      left[i] = folds_[static_cast<std::size_t>(fold)].e[i];
    }
    return left;
  }

 private:
  struct Fold {
    VectorXd weight;  ///< 1 for readings of other folds, kOwnWeight for its own
    MatrixXd normal;  ///< normal equations with these weights
    VectorXd u, e;
    double reach = 1.0;  ///< shortens the attempts
    double objective = std::numeric_limits<double>::infinity();
    bool stands = false;
  };

  /// Objective with the fold's weights, without the slope that the full objective has at the full fit.
  double objective(const Fold& fold, const VectorXd& u, const VectorXd& e) const {
    const VectorXd way = (u - fit_.u)(system_.free);
    return objectiveOf(fit_.model, u, fold.weight.cwiseSqrt().cwiseProduct(e), weighting_) +
           2.0 * descent_.dot(way);
  }

  /// Half the downhill gradient of objective().
  VectorXd descentOf(const Fold& fold) const {
    const VectorXd e = weighting_.weights.cwiseProduct(fold.weight).cwiseProduct(fold.e);
    const VectorXd u = fold.u(system_.free);
    return system_.jacobian.transpose() * e - precision_.cwiseProduct(u) - descent_;
  }

  static VectorXd stepOf(const Fold& fold, const VectorXd& descent, double ridge) {
    MatrixXd normal = fold.normal;
    normal.diagonal().array() += ridge;
    return normal.ldlt().solve(descent).cwiseMax(-kLongestWay).cwiseMin(kLongestWay);
  }

  const FitData& data_;
  const Fit& fit_;
  const Weighting& weighting_;
  FreeSystem system_;
  VectorXd precision_;
  VectorXd descent_;  ///< Jᵀ e − P u of the full fit: half the downhill gradient, 0 at a minimum
  std::vector<Fold> folds_;
  std::vector<Fold*> tried_;  ///< fold of each trial
};

}  // namespace

std::vector<VectorXd> heldOut(const FitData& data, const std::vector<WeightedFit>& fits) {
  std::vector<FoldFits> all;
  for (const auto& [fit, weighting] : fits) all.emplace_back(data, *fit, *weighting);
  for (int step = 0; step < kMostSteps && !data.cancelled(); ++step) {
    std::vector<std::vector<VectorXd>> trials;
    for (FoldFits& one : all) trials.push_back(one.trials());
    if (std::ranges::all_of(trials, &std::vector<VectorXd>::empty)) break;
    const std::vector<MatrixXd> e = residualsWith(data, fits, trials);
    for (std::size_t k = 0; k < all.size(); ++k) all[k].take(trials[k], e[k]);
  }
  std::vector<VectorXd> left;
  for (const FoldFits& one : all) left.push_back(one.heldOut());
  return left;
}

VectorXd heldOut(const FitData& data, const Fit& fit, const Weighting& weighting) {
  return heldOut(data, {{&fit, &weighting}}).front();
}

}  // namespace capstan::diagnosis
