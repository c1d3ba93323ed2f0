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

double objectiveOf(const FitModel& model, const VectorXd& u, const VectorXd& e, const Weighting& weighting) {
  const double misfit = weighting.weights.cwiseProduct(e).squaredNorm();
  const double prior = u.cwiseAbs2().dot(priorPrecision(model));
  return std::isfinite(misfit) ? misfit + prior : std::numeric_limits<double>::infinity();
}

Fit linearise(const FitData& data, const FitModel& model, const VectorXd& u, const InitialStates& initial,
              const Weighting& weighting) {
  return systemAt(data, model, u, initial, weighting).at;
}

Fit fit(const FitData& data, const FitModel& model, const VectorXd& u, const InitialStates& initial,
        const Weighting& weighting, const FitOptions& options, const base::Progress* progress) {
  System system = systemAt(data, model, model.clipped(u), initial, weighting, options.known);
  const VectorXd& weights = weighting.weights;
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
    const Trial best = bestOf(data, system, stepFor, weighting);
    const double gain = system.objective - best.objective;
    if (!(gain > 0.0)) break;
    const bool last = gain < options.tolerance || iteration == options.iterations;
    if (last) {  // the linearisation of the step before is kept
      system.at.u = best.u, system.at.e = best.e, system.at.initial = best.initial;
      system.at.objective = objectiveOf(model, best.u, best.e, weighting);
      system.at.iterations = iteration;
      break;
    }
    system = systemAt(data, model, best.u, best.initial, weighting, options.known);
    system.at.iterations = iteration;
  }
  return system.at;
}

namespace {

MatrixXd residualsFrom(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                       const std::vector<InitialStates>& starts, const Weighting& weighting) {
  MatrixXd e = data.simulate(robots, starts);
  e = -(e.colwise() - data.measured());
  takeOffNuisances(data, at, weighting, e);
  return e;
}

}  // namespace

MatrixXd residualsOf(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                     const Weighting& weighting) {
  return residualsFrom(data, at, robots, std::vector<InitialStates>(robots.size(), at.initial), weighting);
}

MatrixXd residualsWith(const FitData& data, const Fit& at, const std::vector<VectorXd>& numbers,
                       const Weighting& weighting) {
  std::vector<robot::ChainModel> robots;
  std::vector<InitialStates> starts;
  for (const VectorXd& u : numbers) {
    robots.push_back(at.model.chain(u));
    starts.push_back(following(data, at, u - at.u));
  }
  return residualsFrom(data, at, robots, starts, weighting);
}

void takeOffNuisances(const FitData& data, const Fit& at, const Weighting& weighting,
                      Eigen::Ref<MatrixXd> e) {
  takeOffNuisances(data, at.nuisance, nuisancePrecision(data, at.model.chain(at.u)), weighting.weights, e);
}

}  // namespace capstan::diagnosis
