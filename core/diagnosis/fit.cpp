#include "core/diagnosis/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDifference = 1e-3;  // of u, for derivatives
constexpr double kLongestStep = 3.0;  // of any u in one iteration

/// Weights of one stretch, of all its numbers.
MatrixXd weighted(const MatrixXd& x, const VectorXd& weights) { return weights.asDiagonal() * x; }

/// Precision of the nuisances' own estimates: initial positions are known to some counts of the encoder,
/// speeds to a tenth of the largest, those of whole recordings' starts to what the encoder tells (a change of
/// speed there would be a step for all that follows); encoder zeros not at all.
VectorXd nuisancePrecision(const FitData& data, const robot::ChainModel& model) {
  const int n = model.shape.joints;
  if (!data.rigid()) return VectorXd::Zero(n);
  constexpr double kWholeSlope = 500.0;  // of the noise [1/s]
  const ChainSimulation& first = data.simulation(0);
  const bool whole = first.windows().size() == first.evidence().segments.size();
  VectorXd precision(2 * n);
  for (int j = 0; j < n; ++j) {
    double noise = 0.0;
    for (const ComparedChannel& channel : data.channels())
      if (channel.joint == j + 1) noise = std::max(noise, channel.noise);
    const double position = noise > 0.0 ? 4.0 * noise : 0.1 / model.shape.inverse_half_range[j];
    const double most = 0.1 * model.shape.fastest[j] / 20.0;
    const double speed = whole && noise > 0.0 ? std::min(kWholeSlope * noise, most) : most;
    precision[j] = 1.0 / (position * position);
    precision[n + j] = 1.0 / (speed * speed);
  }
  return precision;
}

/// Coefficients of each stretch's nuisances that explain the columns of x best, subtracted from x in place.
std::vector<MatrixXd> takeOffNuisances(const FitData& data, const MatrixXd& nuisance,
                                       const VectorXd& precision, const VectorXd& weights,
                                       Eigen::Ref<MatrixXd> x) {
  std::vector<MatrixXd> coefficients;
  if (nuisance.cols() == 0) return coefficients;
  for (const auto& [begin, end] : data.stretches()) {
    const MatrixXd part = nuisance.middleRows(begin, end - begin);
    const MatrixXd heavy = weighted(part, weights.segment(begin, end - begin).cwiseAbs2());
    MatrixXd normal = heavy.transpose() * part;
    normal.diagonal() += precision;
    normal.diagonal() *= 1.0 + 1e-12;
    coefficients.push_back(normal.ldlt().solve(heavy.transpose() * x.middleRows(begin, end - begin)));
    x.middleRows(begin, end - begin) -= part * coefficients.back();
  }
  return coefficients;
}

/// Small changes of the initial states: of joint positions by their range, of speeds by the largest.
VectorXd initialDifferences(const robot::ChainModel& model) {
  VectorXd h(2 * model.shape.joints);
  for (int j = 0; j < model.shape.joints; ++j) {
    h[j] = 1e-5 / model.shape.inverse_half_range[j];
    h[model.shape.joints + j] = 1e-5 * model.shape.fastest[j];
  }
  return h;
}

InitialStates shifted(InitialStates initial, Index state, double h) {
  for (MatrixXd& x : initial) x.row(state).array() += h;
  return initial;
}

/// Ones where an encoder of joint j told.
MatrixXd encoderZeros(const FitData& data, int joints) {
  MatrixXd zeros = MatrixXd::Zero(data.size(), joints);
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    const ComparedChannel& channel = data.channels()[static_cast<std::size_t>(data.channel()[i])];
    if (channel.joint > 0) zeros(static_cast<Index>(i), channel.joint - 1) = 1.0;
  }
  return zeros;
}

/// Residual, derivatives and nuisances, and what the nuisances of each stretch take off them.
struct System {
  Fit at;
  std::vector<MatrixXd> off_residual, off_jacobian;  ///< by stretch: coefficients of e and of the Jacobian
};

/// Place of the parameter in another model that has it in the same terms; −1: none.
int placeIn(const FitModel& other, const FitParameter& parameter) {
  for (int k = 0; k < other.size(); ++k) {
    const FitParameter& p = other.parameters()[static_cast<std::size_t>(k)];
    if (p.name == parameter.name && p.joint == parameter.joint && p.scale == parameter.scale &&
        p.logarithmic == parameter.logarithmic)
      return k;
  }
  return -1;
}

/// u with number k moved a little, away from a bound.
VectorXd moved(const FitModel& model, const VectorXd& u, int k) {
  VectorXd to = u;
  to[k] += kDifference;
  if ((model.clipped(to) - to).cwiseAbs().maxCoeff() > 1e-12) to[k] -= 2.0 * kDifference;
  return to;
}

System systemAt(const FitData& data, const FitModel& model, const VectorXd& u, const InitialStates& initial,
                const Trust& trust, const Fit* known = nullptr) {
  const int p = model.size();
  std::vector<robot::ChainModel> robots(1, model.chain(u));
  MatrixXd jacobian(data.size(), p);
  std::vector<std::pair<int, double>> steps;  // parameters to simulate, and how far they move
  for (int k = 0; k < p; ++k) {
    const int place = known ? placeIn(known->model, model.parameters()[static_cast<std::size_t>(k)]) : -1;
    if (place >= 0) {
      jacobian.col(k) = known->jacobian.col(place);
      continue;
    }
    const VectorXd to = moved(model, u, k);
    steps.emplace_back(k, to[k] - u[k]);
    robots.push_back(model.chain(to));
  }
  std::vector<InitialStates> starts(robots.size(), initial);
  const VectorXd h = initialDifferences(robots.front());
  const bool states = data.rigid() && !(known && known->nuisance.cols() == h.size());
  for (Index s = 0; states && s < h.size(); ++s) {
    robots.push_back(robots.front());
    starts.push_back(shifted(initial, s, h[s]));
  }
  const MatrixXd told = data.simulate(robots, starts);
  for (std::size_t i = 0; i < steps.size(); ++i)
    jacobian.col(steps[i].first) = (told.col(static_cast<Index>(i) + 1) - told.col(0)) / steps[i].second;
  System system{
      {model, u, initial, data.measured() - told.col(0), std::move(jacobian), {}, {}, 0.0, 0}, {}, {}};
  if (states) {
    system.at.nuisance.resize(data.size(), h.size());
    const auto first = static_cast<Index>(steps.size()) + 1;
    for (Index s = 0; s < h.size(); ++s)
      system.at.nuisance.col(s) = (told.col(first + s) - told.col(0)) / h[s];
  } else if (data.rigid()) {
    system.at.nuisance = known->nuisance;
  } else if (data.zerosFree()) {
    system.at.nuisance = encoderZeros(data, robots.front().shape.joints);
  }
  const VectorXd precision = nuisancePrecision(data, robots.front());
  system.off_residual = takeOffNuisances(data, system.at.nuisance, precision, trust.weights, system.at.e);
  system.off_jacobian =
      takeOffNuisances(data, system.at.nuisance, precision, trust.weights, system.at.jacobian);
  system.at.objective = objectiveOf(model, u, system.at.e, trust);
  return system;
}

VectorXd usedWeights(const Trust& trust) {
  VectorXd w = trust.weights;
  for (std::size_t i = 0; i < trust.used.size(); ++i)
    if (!trust.used[i]) w[static_cast<Index>(i)] = 0.0;
  return w;
}

VectorXd priorPrecision(const FitModel& model) {
  VectorXd precision(model.size());
  for (int k = 0; k < model.size(); ++k) {
    const double prior = model.parameters()[static_cast<std::size_t>(k)].prior;
    precision[k] = 1.0 / (prior * prior);
  }
  return precision;
}

/// Step of the normal equations with the damping, bounds kept: what would leave them stays at them.
class BoundedStep {
 public:
  BoundedStep(const FitModel& model, const VectorXd& u, MatrixXd normal, VectorXd gradient)
      : model_(model), u_(u), normal_(std::move(normal)), gradient_(std::move(gradient)) {}

  VectorXd operator()(double damping, std::vector<bool>* bound = nullptr) const {
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

 private:
  VectorXd solve(double damping, const std::vector<bool>& held) const {
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

  const FitModel& model_;
  const VectorXd& u_;
  MatrixXd normal_;
  VectorXd gradient_;
};

/// Initial states where the linearisation puts them after a step of u.
InitialStates movedStates(const FitData& data, const System& system, const VectorXd& step) {
  InitialStates initial = system.at.initial;
  if (!data.rigid()) return initial;
  std::size_t stretch = 0;
  for (int r = 0; r < data.recordings(); ++r) {
    const Compared& compared = data.simulation(r).compared();
    for (std::size_t w = 0; w + 1 < compared.window_begin.size(); ++w) {
      if (compared.window_begin[w] == compared.window_begin[w + 1]) continue;
      initial[static_cast<std::size_t>(r)].col(static_cast<Index>(w)) +=
          system.off_residual[stretch].col(0) - system.off_jacobian[stretch] * step;
      ++stretch;
    }
  }
  return initial;
}

struct Trial {
  VectorXd u, e;
  InitialStates initial;
  double objective = std::numeric_limits<double>::infinity();
};

/// The best of 16 steps.
Trial bestOf(const FitData& data, const System& system, const BoundedStep& stepFor, const Trust& trust) {
  constexpr double kDampings[] = {0.0, 1e-2, 0.1, 1.0, 10.0, 100.0};
  constexpr double kLengths[] = {1.0, 0.5, 0.2};
  std::vector<Trial> trials;
  std::vector<robot::ChainModel> robots;
  std::vector<InitialStates> starts;
  const FitModel& model = system.at.model;
  for (const double damping : kDampings)
    for (const double length : kLengths) {
      if (trials.size() == robot::kChainLanes) break;
      VectorXd step = stepFor(damping);
      const double longest = step.size() ? step.cwiseAbs().maxCoeff() : 0.0;
      step *= length * std::min(1.0, kLongestStep / std::max(longest, 1e-12));
      Trial trial;
      trial.u = model.clipped(system.at.u + step);
      trial.initial = movedStates(data, system, trial.u - system.at.u);
      robots.push_back(model.chain(trial.u));
      starts.push_back(trial.initial);
      trials.push_back(std::move(trial));
    }
  const MatrixXd told = data.simulate(robots, starts);
  std::size_t best = 0;
  for (std::size_t k = 0; k < trials.size(); ++k) {
    Trial& trial = trials[k];
    trial.e = data.measured() - told.col(static_cast<Index>(k));
    if (!trial.e.allFinite()) continue;
    takeOffNuisances(data, system.at.nuisance, nuisancePrecision(data, robots[k]), trust.weights, trial.e);
    trial.objective = objectiveOf(model, trial.u, trial.e, trust);
    if (trial.objective < trials[best].objective) best = k;
  }
  return trials[best];
}

}  // namespace

InitialStates noneBeyond(const FitData& data) {
  InitialStates initial;
  for (int r = 0; r < data.recordings(); ++r) {
    const MatrixXd& own = data.simulation(r).initialStates();
    initial.push_back(MatrixXd::Zero(own.rows(), own.cols()));
  }
  return initial;
}

double objectiveOf(const FitModel& model, const VectorXd& u, const VectorXd& e, const Trust& trust) {
  const double misfit = usedWeights(trust).cwiseProduct(e).squaredNorm();
  const double prior = u.cwiseAbs2().dot(priorPrecision(model));
  return std::isfinite(misfit) ? misfit + prior : std::numeric_limits<double>::infinity();
}

Fit linearise(const FitData& data, const FitModel& model, const VectorXd& u, const InitialStates& initial,
              const Trust& trust) {
  return systemAt(data, model, u, initial, trust).at;
}

Fit fit(const FitData& data, const FitModel& model, const VectorXd& u, const InitialStates& initial,
        const Trust& trust, const FitOptions& options, const base::Progress* progress) {
  System system = systemAt(data, model, model.clipped(u), initial, trust, options.known);
  const VectorXd weights = usedWeights(trust);
  for (int iteration = 1; iteration <= options.iterations; ++iteration) {
    if (progress && progress->cancelled()) break;
    const MatrixXd jacobian = weighted(system.at.jacobian, weights);
    MatrixXd normal = jacobian.transpose() * jacobian;
    VectorXd gradient = jacobian.transpose() * weights.cwiseProduct(system.at.e);
    const VectorXd precision = priorPrecision(model);
    normal.diagonal() += precision;
    gradient -= precision.cwiseProduct(system.at.u);
    const BoundedStep stepFor(model, system.at.u, normal, gradient);
    stepFor(0.0, &system.at.bound);
    const Trial best = bestOf(data, system, stepFor, trust);
    const double gain = system.at.objective - best.objective;
    if (!(gain > 0.0)) break;
    const bool last = gain < options.tolerance || iteration == options.iterations;
    if (last) {  // the linearisation of a step before serves
      system.at.u = best.u, system.at.e = best.e, system.at.initial = best.initial;
      system.at.objective = best.objective;
      system.at.iterations = iteration;
      break;
    }
    system = systemAt(data, model, best.u, best.initial, trust, options.known);
    system.at.iterations = iteration;
  }
  return system.at;
}

MatrixXd residualsOf(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                     const Trust& trust) {
  MatrixXd e = data.simulate(robots, std::vector<InitialStates>(robots.size(), at.initial));
  e = -(e.colwise() - data.measured());
  takeOffNuisances(data, at, trust, e);
  return e;
}

void takeOffNuisances(const FitData& data, const Fit& at, const Trust& trust, Eigen::Ref<MatrixXd> e) {
  takeOffNuisances(data, at.nuisance, nuisancePrecision(data, at.model.chain(at.u)), trust.weights, e);
}

}  // namespace capstan::diagnosis
