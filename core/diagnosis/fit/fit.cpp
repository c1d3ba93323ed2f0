#include "core/diagnosis/fit/fit.h"

#include <cmath>
#include <limits>

#include "core/diagnosis/fit/fit_step.h"
#include "core/diagnosis/fit/linear_system.h"

namespace capstan::diagnosis {

using Eigen::MatrixXd;
using Eigen::VectorXd;

InitialStates noneBeyond(const FitData& data) {
  InitialStates initial;
  for (int r = 0; r < data.recordings(); ++r) {
    const MatrixXd& own = data.simulation(r).initialStates();
    initial.push_back(MatrixXd::Zero(own.rows(), own.cols()));
  }
  return initial;
}

double objectiveOf(const FitModel& model, const VectorXd& u, const VectorXd& e, const Trust& trust) {
  const double misfit = trust.weights.cwiseProduct(e).squaredNorm();
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
  const VectorXd& weights = trust.weights;
  for (int iteration = 1; iteration <= options.iterations; ++iteration) {
    if (progress && progress->cancelled()) break;
    const MatrixXd jacobian = weights.asDiagonal() * system.at.jacobian;
    MatrixXd normal = jacobian.transpose() * jacobian;
    VectorXd gradient = jacobian.transpose() * weights.cwiseProduct(system.at.e);
    const VectorXd precision = priorPrecision(model);
    normal.diagonal() += precision;
    gradient -= precision.cwiseProduct(system.at.u);
    const BoundedStep stepFor(model, system.at.u, normal, gradient);
    stepFor(0.0, &system.at.bound);
    const Trial best = bestOf(data, system, stepFor, trust);
    const double gain = system.objective - best.objective;
    if (!(gain > 0.0)) break;
    const bool last = gain < options.tolerance || iteration == options.iterations;
    if (last) {  // the linearisation of a step before serves
      system.at.u = best.u, system.at.e = best.e, system.at.initial = best.initial;
      system.at.objective = objectiveOf(model, best.u, best.e, trust);
      system.at.iterations = iteration;
      break;
    }
    system = systemAt(data, model, best.u, best.initial, trust, options.known);
    system.at.iterations = iteration;
  }
  return system.at;
}

namespace {

MatrixXd residualsFrom(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                       const std::vector<InitialStates>& starts, const Trust& trust) {
  MatrixXd e = data.simulate(robots, starts);
  e = -(e.colwise() - data.measured());
  takeOffNuisances(data, at, trust, e);
  return e;
}

}  // namespace

MatrixXd residualsOf(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                     const Trust& trust) {
  return residualsFrom(data, at, robots, std::vector<InitialStates>(robots.size(), at.initial), trust);
}

MatrixXd residualsWith(const FitData& data, const Fit& at, const std::vector<VectorXd>& numbers,
                       const Trust& trust) {
  std::vector<robot::ChainModel> robots;
  std::vector<InitialStates> starts;
  for (const VectorXd& u : numbers) {
    robots.push_back(at.model.chain(u));
    starts.push_back(following(data, at, u - at.u));
  }
  return residualsFrom(data, at, robots, starts, trust);
}

void takeOffNuisances(const FitData& data, const Fit& at, const Trust& trust, Eigen::Ref<MatrixXd> e) {
  takeOffNuisances(data, at.nuisance, nuisancePrecision(data, at.model.chain(at.u)), trust.weights, e);
}

}  // namespace capstan::diagnosis
