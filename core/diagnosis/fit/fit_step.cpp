#include "core/diagnosis/fit/fit_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <span>

namespace capstan::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kLongestStep = 3.0;  // largest change of any u in one iteration

struct Attempt {
  double damping, length;
};
constexpr Attempt kAttempts[] = {{0.0, 1.0},  {0.0, 0.5},  {0.0, 0.2},  {1e-2, 1.0}, {1e-2, 0.5}, {1e-2, 0.2},
                                 {0.1, 1.0},  {0.1, 0.5},  {0.1, 0.2},  {1.0, 1.0},  {1.0, 0.5},  {1.0, 0.2},
                                 {10.0, 1.0}, {10.0, 0.5}, {10.0, 0.2}, {100.0, 1.0}};
/// Attempts of a coarse fit.
constexpr Attempt kCoarseAttempts[] = {{0.0, 1.0}, {0.0, 0.3}, {0.1, 1.0}, {1.0, 1.0}};
/// Shares of the linearised change of the initial states; every attempt of a rigid drive is tried with each.
constexpr double kShares[] = {1.0, 0.4, 0.1};
constexpr Attempt kRigidAttempts[] = {{0.0, 1.0}, {0.0, 0.4}, {0.0, 0.1}, {0.1, 1.0}, {1.0, 1.0}};

/// Initial states after a step of u, plus the share `share` of the correction that the linearisation
/// predicts.
InitialStates movedStates(const FitData& data, const System& system, const VectorXd& step, double share) {
  InitialStates initial = following(data, system.at, step);
  if (data.rigid())
    forSegments(data, [&](std::size_t r, Index w, std::size_t segment) {
      initial[r].col(w) += share * system.off_residual[segment].col(0);
    });
  return initial;
}

std::span<const double> sharesFor(const FitData& data) {
  return data.rigid() ? std::span<const double>(kShares) : std::span<const double>(kShares, 1);
}

std::span<const Attempt> attemptsFor(const FitData& data, bool coarse) {
  if (data.rigid()) return kRigidAttempts;
  return coarse ? std::span<const Attempt>(kCoarseAttempts) : std::span<const Attempt>(kAttempts);
}

/// Each attempt with each share, not simulated yet.
std::vector<Trial> trialsOf(const FitData& data, const StepOrigin& origin) {
  const System& system = *origin.system;
  std::vector<Trial> trials;
  for (const auto& [damping, length] : attemptsFor(data, origin.coarse)) {
    VectorXd step = (*origin.stepFor)(damping);
    const double longest = step.size() ? step.cwiseAbs().maxCoeff() : 0.0;
    step *= length * std::min(1.0, kLongestStep / std::max(longest, 1e-12));
    const VectorXd u = system.at.model.clipped(system.at.u + step);
    for (const double share : sharesFor(data))
      trials.push_back({u, {}, movedStates(data, system, u - system.at.u, share)});
  }
  return trials;
}

/// Simulates the trials of all origins side by side: residuals without nuisances subtracted.
void simulate(const FitData& data, const std::vector<StepOrigin>& origins,
              std::vector<std::vector<Trial>>& trials) {
  std::vector<robot::ChainModel> robots;
  std::vector<InitialStates> starts;
  std::vector<std::size_t> family;
  for (std::size_t k = 0; k < origins.size(); ++k)
    for (const Trial& trial : trials[k]) {
      family.push_back(k);
      robots.push_back(origins[k].system->at.model.chain(trial.u));
      starts.push_back(trial.initial);
    }
  const MatrixXd readings = data.simulate(robots, starts, family);
  Index column = 0;
  for (std::vector<Trial>& of_origin : trials)
    for (Trial& trial : of_origin) trial.e = data.measured() - readings.col(column++);
}

/// Combines trials with the same u: each segment is taken from the trial that fits it best.
Trial mixed(const FitData& data, std::span<const Trial> trials, const Weighting& weighting) {
  Trial best = trials.front();
  forSegments(data, [&](std::size_t r, Index w, std::size_t segment) {
    const auto [begin, end] = data.segments()[segment];
    const VectorXd weight = weighting.weights.segment(begin, end - begin);
    double least = std::numeric_limits<double>::infinity();
    for (const Trial& trial : trials) {
      const double misfit = weight.cwiseProduct(trial.e.segment(begin, end - begin)).squaredNorm();
      if (!(misfit < least)) continue;
      least = misfit;
      best.e.segment(begin, end - begin) = trial.e.segment(begin, end - begin);
      best.initial[r].col(w) = trial.initial[r].col(w);
    }
  });
  return best;
}

/// Best of the simulated trials of one origin.
Trial bestOf(const FitData& data, const StepOrigin& origin, std::span<const Trial> trials) {
  const System& system = *origin.system;
  const Weighting& weighting = *origin.weighting;
  const std::size_t shares = sharesFor(data).size();
  const VectorXd precision = nuisancePrecision(data, system.at.model.chain(system.at.u));
  Trial best;
  for (std::size_t k = 0; k < trials.size(); k += shares) {
    Trial trial = data.rigid() ? mixed(data, trials.subspan(k, shares), weighting) : trials[k];
    if (!trial.e.allFinite()) continue;
    const VectorXd as_simulated = trial.e;
    takeOffNuisances(data, system.at.nuisance, precision, weighting.weights, trial.e);
    trial.objective = reached(data, system.at.model, trial.u, as_simulated, trial.e, weighting);
    if (best.u.size() == 0 || trial.objective < best.objective) best = std::move(trial);
  }
  return best;
}

}  // namespace

VectorXd BoundedStep::operator()(double damping, std::vector<bool>* bound) const {
  std::vector<bool> held(static_cast<std::size_t>(u_.size()), false);
  VectorXd step;
  for (int pass = 0; pass < 4; ++pass) {
    step = solve(damping, held);
    const VectorXd kept = model_.clipped(u_ + step);
    bool more = false;
    for (Index k = 0; k < u_.size(); ++k) {
      const bool stays = std::abs(kept[k] - u_[k]) < 1e-9 && std::abs(step[k]) > 1e-9;
      if (!stays || held[static_cast<std::size_t>(k)]) continue;
      held[static_cast<std::size_t>(k)] = more = true;
    }
    if (!more) break;
  }
  if (bound) *bound = held;
  return step;
}

VectorXd BoundedStep::solve(double damping, const std::vector<bool>& held) const {
  MatrixXd a = normal_;
  VectorXd b = gradient_;
  a.diagonal() *= 1.0 + damping;
  for (Index k = 0; k < u_.size(); ++k) {
    if (!held[static_cast<std::size_t>(k)]) continue;
    a.row(k).setZero();
    a.col(k).setZero();
    a(k, k) = 1.0;
    b[k] = 0.0;
  }
  return a.ldlt().solve(b);
}

std::vector<Trial> bestSteps(const FitData& data, const std::vector<StepOrigin>& origins) {
  std::vector<std::vector<Trial>> trials;
  for (const StepOrigin& origin : origins) trials.push_back(trialsOf(data, origin));
  simulate(data, origins, trials);
  std::vector<Trial> best;
  for (std::size_t k = 0; k < origins.size(); ++k) best.push_back(bestOf(data, origins[k], trials[k]));
  return best;
}

}  // namespace capstan::diagnosis
