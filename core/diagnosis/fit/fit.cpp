#include "core/diagnosis/fit/fit.h"

#include <cmath>
#include <limits>
#include <map>

#include "core/diagnosis/fit/fit_step.h"
#include "core/diagnosis/fit/linear_system.h"

namespace capstan::diagnosis {

using Eigen::Index;
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
  return systemsAt(data, {{&model, u, initial, &weighting, nullptr}}).front().at;
}

namespace {

LinearisationPoint pointOf(const FitTask& task, VectorXd u, InitialStates initial) {
  return {&task.model, std::move(u), std::move(initial), &task.weighting, task.options.known};
}

LinearisationPoint startOf(const FitTask& task) {
  LinearisationPoint point = pointOf(task, task.model.clipped(task.u), task.initial);
  if (task.options.begun) point.known = task.options.begun;
  return point;
}

/// Damped normal equations of the linearised system.
BoundedStep stepAt(const System& system, const Weighting& weighting) {
  const MatrixXd jacobian = weighting.weights.asDiagonal() * system.at.jacobian;
  MatrixXd normal = jacobian.transpose() * jacobian;
  VectorXd gradient = jacobian.transpose() * weighting.weights.cwiseProduct(system.at.e);
  const VectorXd precision = priorPrecision(system.at.model);
  normal.diagonal() += precision;
  gradient -= precision.cwiseProduct(system.at.u);
  return {system.at.model, system.at.u, std::move(normal), std::move(gradient)};
}

/// Largest number of successive steps whose secant updates the derivatives of a cable drive's fit, instead of
/// a linearisation, which simulates every parameter.
constexpr int kSecants = 3;
/// A secant is taken if the squared error of the step's linear prediction is below this share of the fall of
/// the objective. Otherwise the derivatives have changed too much.
constexpr double kLinear = 0.1;

/// Whether the linearisation predicted the residuals of the trial well.
bool wasLinear(const System& system, const Trial& trial, const FitTask& task) {
  const VectorXd step = trial.u - system.at.u;
  const VectorXd off = system.at.e - trial.e - system.at.jacobian * step;
  return step.squaredNorm() > 0.0 && task.weighting.weights.cwiseProduct(off).squaredNorm() <
                                         kLinear * (system.objective - trial.objective);
}

/// Moves the linearisation to the trial. The derivatives J become those with the smallest change that agrees
/// with the step du and the change dy of the simulated readings (Broyden, A class of methods for solving
/// nonlinear simultaneous equations, Mathematics of Computation 19, 1965):
///     J += (dy − J du) duᵀ / (duᵀ du).
void followSecant(System& system, Trial trial, const FitTask& task) {
  Fit& at = system.at;
  const VectorXd step = trial.u - at.u, off = at.e - trial.e - at.jacobian * step;
  at.jacobian += off * (step / step.squaredNorm()).transpose();
  at.u = std::move(trial.u), at.e = std::move(trial.e), at.initial = std::move(trial.initial);
  at.objective = objectiveOf(task.model, at.u, at.e, task.weighting);
  system.objective = trial.objective;
}

/// Fits that proceed together, one iteration at a time.
class FitBatch {
 public:
  FitBatch(const FitData& data, const std::vector<FitTask>& tasks) : data_(data), tasks_(tasks) {
    std::vector<LinearisationPoint> points;
    for (const FitTask& task : tasks) points.push_back(startOf(task));
    systems_ = systemsAt(data, points);
    secants_.assign(tasks.size(), 0);
    linearised_.assign(tasks.size(), 1);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      if (tasks[k].options.begun) secants_[k] = 1;
      if (tasks[k].options.iterations > 0) going_.push_back(k);
    }
  }

  bool done() const { return going_.empty(); }

  void iterate(int iteration) {
    std::vector<Trial> trials = stepAll();
    if (data_.cancelled()) return;
    std::vector<std::size_t> on, linearised;
    std::vector<LinearisationPoint> points;
    const auto lineariseAt = [&](std::size_t k, VectorXd u, InitialStates initial) {
      linearised.push_back(k);
      points.push_back(pointOf(tasks_[k], std::move(u), std::move(initial)));
    };
    for (std::size_t i = 0; i < going_.size(); ++i) {
      const std::size_t k = going_[i];
      System& system = systems_[k];
      Trial& trial = trials[i];
      const double gain = system.objective - trial.objective;
      const bool better = gain > 0.0, small = !(gain >= tasks_[k].options.tolerance);
      const bool exact = secants_[k] == 0;  // the derivatives were simulated
      if (!small && takesSecant(k) && wasLinear(system, trial, tasks_[k])) {
        followSecant(system, std::move(trial), tasks_[k]);
        ++secants_[k];
        on.push_back(k);
        continue;
      }
      const bool ends = linearised_[k] >= tasks_[k].options.iterations || (small && exact);
      if (!ends) on.push_back(k);
      if (ends && exact) {
        if (better) finish(system.at, std::move(trial), tasks_[k], iteration);
      } else if (better) {
        lineariseAt(k, std::move(trial.u), std::move(trial.initial));
      } else {
        lineariseAt(k, system.at.u, system.at.initial);
      }
    }
    std::vector<System> next = systemsAt(data_, points);
    for (std::size_t i = 0; i < linearised.size(); ++i) {
      systems_[linearised[i]] = std::move(next[i]);
      secants_[linearised[i]] = 0;
      ++linearised_[linearised[i]];
    }
    for (const std::size_t k : on) systems_[k].at.iterations = iteration;
    going_ = std::move(on);
  }

  std::vector<Fit> results() {
    std::vector<Fit> fits;
    for (System& system : systems_) fits.push_back(std::move(system.at));
    return fits;
  }

 private:
  /// Secants serve fits whose linearisation simulates every parameter.
  bool takesSecant(std::size_t k) const {
    return !data_.rigid() && tasks_[k].options.known == nullptr && secants_[k] < kSecants;
  }

  std::vector<Trial> stepAll() {
    std::vector<BoundedStep> steps;
    steps.reserve(going_.size());
    std::vector<StepOrigin> origins;
    for (const std::size_t k : going_) {
      const BoundedStep& step = steps.emplace_back(stepAt(systems_[k], tasks_[k].weighting));
      step(0.0, &systems_[k].at.bound);
      origins.push_back({&systems_[k], &step, &tasks_[k].weighting, tasks_[k].options.coarse});
    }
    return bestSteps(data_, origins);
  }

  /// Takes the last step; the linearisation of the step before is kept.
  static void finish(Fit& at, Trial best, const FitTask& task, int iteration) {
    at.u = std::move(best.u), at.e = std::move(best.e), at.initial = std::move(best.initial);
    at.objective = objectiveOf(task.model, at.u, at.e, task.weighting);
    at.iterations = iteration;
  }

  const FitData& data_;
  const std::vector<FitTask>& tasks_;
  std::vector<System> systems_;
  std::vector<int> secants_;     ///< steps since the last linearisation, by fit
  std::vector<int> linearised_;  ///< number of linearisations, by fit
  std::vector<std::size_t> going_;
};

}  // namespace

std::vector<Fit> fitAll(const FitData& data, const std::vector<FitTask>& tasks) {
  FitBatch batch(data, tasks);
  for (int iteration = 1; !batch.done() && !data.cancelled(); ++iteration) batch.iterate(iteration);
  return batch.results();
}

Fit fit(const FitData& data, const FitModel& model, const VectorXd& u, const InitialStates& initial,
        const Weighting& weighting, const FitOptions& options) {
  return fitAll(data, {{model, u, initial, weighting, options}}).front();
}

MatrixXd changesTo(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                   const Weighting& weighting) {
  std::vector<robot::ChainModel> models = robots;
  std::vector<std::size_t> family;
  std::map<std::vector<int>, std::size_t> families;  // by integration steps in each recording
  const robot::ChainModel own = at.model.chain(at.u);
  for (const robot::ChainModel& robot : robots) {
    std::vector<int> steps;
    for (int r = 0; r < data.recordings(); ++r)
      steps.push_back(std::max(data.simulation(r).stepsFor(robot), data.simulation(r).stepsFor(own)));
    family.push_back(families.try_emplace(std::move(steps), families.size()).first->second);
  }
  for (std::size_t k = 0; k < families.size(); ++k) {  // the fit's robot, once in each family
    models.push_back(own);
    family.push_back(k);
  }
  const MatrixXd readings =
      data.simulate(models, std::vector<InitialStates>(models.size(), at.initial), family);
  MatrixXd changes(data.size(), static_cast<Index>(robots.size()));
  for (std::size_t k = 0; k < robots.size(); ++k)
    changes.col(static_cast<Index>(k)) =
        readings.col(static_cast<Index>(k)) - readings.col(static_cast<Index>(robots.size() + family[k]));
  takeOffNuisances(data, at, weighting, changes);
  return changes;
}

std::vector<MatrixXd> residualsWith(const FitData& data, const std::vector<WeightedFit>& fits,
                                    const std::vector<std::vector<VectorXd>>& parameters) {
  std::vector<robot::ChainModel> robots;
  std::vector<InitialStates> starts;
  std::vector<std::size_t> family;
  for (std::size_t k = 0; k < fits.size(); ++k)
    for (const VectorXd& u : parameters[k]) {
      const Fit& at = *fits[k].fit;
      robots.push_back(at.model.chain(u));
      starts.push_back(following(data, at, u - at.u));
      family.push_back(k);
    }
  const MatrixXd readings = data.simulate(robots, starts, family);
  std::vector<MatrixXd> residuals;
  Index first = 0;
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const auto count = static_cast<Index>(parameters[k].size());
    MatrixXd e = -(readings.middleCols(first, count).colwise() - data.measured());
    takeOffNuisances(data, *fits[k].fit, *fits[k].weighting, e);
    residuals.push_back(std::move(e));
    first += count;
  }
  return residuals;
}

std::vector<double> objectivesAt(const FitData& data, const Fit& at, const std::vector<FitTask>& tasks) {
  std::vector<robot::ChainModel> robots;
  std::vector<InitialStates> starts;
  std::vector<std::size_t> family;
  for (const FitTask& task : tasks) {
    family.push_back(family.size());
    robots.push_back(task.model.chain(task.model.clipped(task.u)));
    starts.push_back(task.initial);
  }
  const MatrixXd readings = data.simulate(robots, starts, family);
  std::vector<double> objectives;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    MatrixXd e = data.measured() - readings.col(static_cast<Index>(k));
    if (e.allFinite()) takeOffNuisances(data, at, tasks[k].weighting, e);
    objectives.push_back(objectiveOf(tasks[k].model, tasks[k].u, e, tasks[k].weighting));
  }
  return objectives;
}

void takeOffNuisances(const FitData& data, const Fit& at, const Weighting& weighting,
                      Eigen::Ref<MatrixXd> e) {
  takeOffNuisances(data, at.nuisance, nuisancePrecision(data, at.model.chain(at.u)), weighting.weights, e);
}

}  // namespace capstan::diagnosis
