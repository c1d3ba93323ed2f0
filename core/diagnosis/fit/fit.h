#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/evidence/encoder_zeros.h"
#include "core/diagnosis/fit/chain_simulation.h"
#include "core/diagnosis/fit/fit_model.h"

namespace capstan::diagnosis {

/// Offsets of the initial states from those of the simulations: one matrix 4n × windows per recording.
using InitialStates = std::vector<Eigen::MatrixXd>;

/// All recordings of one robot for a fit. Readings are stacked recording by recording. Within a recording
/// they are in the order of the struct Compared of its simulation.
class FitData {
 public:
  FitData(const std::vector<Evidence>& recordings, const robot::Description& robot, double horizon,
          EncoderZeros zeros, int threads, const base::Progress* progress = nullptr);

  int recordings() const { return static_cast<int>(simulations_.size()); }
  const ChainSimulation& simulation(int r) const { return *simulations_[static_cast<std::size_t>(r)]; }
  Eigen::Index size() const { return measured_.size(); }
  Eigen::Index first(int r) const { return first_[static_cast<std::size_t>(r)]; }
  const Eigen::VectorXd& measured() const { return measured_; }
  int threads() const { return threads_; }
  bool rigid() const { return rigid_; }
  /// True once the caller's progress is cancelled.
  bool cancelled() const { return progress_ && progress_->cancelled(); }
  /// Work of all calls of simulate() until now: integration steps × joints of all robots (rigid drives: ×
  /// joints²). The same on every machine.
  double work() const { return work_; }
  /// Sets what is called with the work done until now after each part of a simulation, by one thread at a
  /// time; empty: nothing.
  void onWork(std::function<void(double)> report) const { on_work_ = std::move(report); }
  /// True if the zeros of the joint encoders are unknown and are fitted.
  bool zerosFree() const { return zeros_ != EncoderZeros::kKnown; }

  /// Sensor channels of all recordings, in order; channel()[i] is the channel of reading i.
  const std::vector<ComparedChannel>& channels() const { return channels_; }
  const std::vector<int>& channel() const { return channel_; }
  /// Number of sensors; sensorOf()[c] is the sensor of channel c. The channels of all recordings that a
  /// joint's encoder or an axis of the cameras has made are of one sensor.
  int sensors() const { return sensors_; }
  const std::vector<int>& sensorOf() const { return sensor_of_; }
  /// Number of time blocks, the units of cross-validation and bootstrap. A block lasts about kBlock. With
  /// rigid drives, a window shorter than 4 kBlock is a single block. block()[i] is the block of reading i.
  int blocks() const { return blocks_; }
  const std::vector<int>& block() const { return block_; }
  /// Number of folds of cross-validation; fold() is the fold of a block. Folds are whole recordings if there
  /// are kWholeFolds or more, since a model should hold for recordings that it has not met; else block b
  /// belongs to fold b mod kFolds.
  int folds() const;
  int fold(int block) const;
  /// Segments with their own nuisances, each as readings [begin, end). Nuisances are the initial states of a
  /// rigid drive's window, or the encoder zeros of one recording or of all.
  const std::vector<std::pair<Eigen::Index, Eigen::Index>>& segments() const { return segments_; }

  /// Simulated readings of several robots, one column per robot. `initial` has the offsets of the initial
  /// states of each robot; empty: no offsets. `family` numbers the robots' families, whose robots are
  /// compared with each other and therefore integrated with equal steps; empty: all are one family.
  Eigen::MatrixXd simulate(const std::vector<robot::ChainModel>& models,
                           const std::vector<InitialStates>& initial = {},
                           const std::vector<std::size_t>& family = {}) const;

 private:
  void stack(const ChainSimulation& simulation);
  void addChannel(const ComparedChannel& channel);

  std::vector<std::unique_ptr<ChainSimulation>> simulations_;
  std::vector<Eigen::Index> first_;
  Eigen::VectorXd measured_;
  std::vector<ComparedChannel> channels_;
  std::vector<int> channel_, sensor_of_, block_;
  std::vector<int> recording_of_;  ///< of each block
  std::vector<std::pair<Eigen::Index, Eigen::Index>> segments_;
  int blocks_ = 0, sensors_ = 0, threads_ = 1;
  bool rigid_ = false;
  mutable double work_ = 0.0;
  mutable std::function<void(double)> on_work_;
  const base::Progress* progress_ = nullptr;
  EncoderZeros zeros_ = EncoderZeros::kKnown;
};
inline constexpr double kBlock = 1.0;  ///< duration of a time block [s]
inline constexpr int kFolds = 8;       ///< largest number of folds
inline constexpr int kWholeFolds = 4;  ///< recordings from which a fold is whole ones: 3/4 of the data remain

/// Offsets 0 of all initial states.
InitialStates noneBeyond(const FitData& data);

/// State of a fit: model, estimate, residuals and linearisation.
struct Fit {
  FitModel model;
  Eigen::VectorXd u = {};
  InitialStates initial = {};
  Eigen::VectorXd e = {};         ///< measured − simulated, with nuisances subtracted
  Eigen::MatrixXd jacobian = {};  ///< d simulated / du, with nuisances subtracted
  Eigen::MatrixXd nuisance = {};  ///< d simulated / d nuisance, of the reading's own segment
  /// Coefficients of the nuisances that were subtracted from `jacobian`, one matrix per segment. After a step
  /// du of u, the best-fitting nuisances change by −removed · du.
  std::vector<Eigen::MatrixXd> removed = {};
  std::vector<bool> bound = {};  ///< true for parameters that a bound stops
  double objective = 0.0;        ///< objectiveOf() the residuals e
  int iterations = 0;            ///< number of steps
};

/// Weights of the readings in a fit.
struct Weighting {
  Eigen::VectorXd weights;  ///< 1 / standard deviation of each reading
};

/// A fit and its weights.
struct WeightedFit {
  const Fit* fit = nullptr;
  const Weighting* weighting = nullptr;
};

struct FitOptions {
  int iterations = 12;     ///< largest number of linearisations
  double tolerance = 0.1;  ///< decrease of the objective below which the fit has converged
  /// Fit whose derivatives are reused for the parameters that both fits have (cable drives). This is coarser
  /// and faster, for a first ranking.
  const Fit* known = nullptr;
  /// Fit of the same model at the same u, whose derivatives, a few steps old or with other weights, serve the
  /// first steps (cable drives). The fit does not end before it has simulated its own.
  const Fit* begun = nullptr;
  bool coarse = false;  ///< true: fewer dampings and lengths of each step are tried (cable drives)
};

/// One of several fits.
struct FitTask {
  FitModel model;
  Eigen::VectorXd u;  ///< start
  InitialStates initial;
  Weighting weighting;
  FitOptions options = {};
};

/// Least squares on the simulation error with priors,
///     Σ (w_i e_i)² + Σ (u_k / prior_k)²:
/// Gauss–Newton with forward differences; 16 robots with perturbed parameters are simulated in parallel. With
/// cable drives, secants replace some of the forward differences between the first and the last step.
/// Several dampings and lengths of each step are tried at once (Levenberg–Marquardt), and each step is kept
/// inside the bounds. Encoder zeros are solved for in each segment. Initial states of rigid drives are solved
/// for in each segment too: the linearised step is tried at several fractions of its length, and each trial
/// is judged by a simulation, because static friction is strongly nonlinear. Ends early, with the estimate so
/// far, when the data's progress is cancelled. All fits proceed together, so that the robots of all of them
/// are simulated in parallel.
std::vector<Fit> fitAll(const FitData& data, const std::vector<FitTask>& tasks);
/// The same with one fit.
Fit fit(const FitData& data, const FitModel& model, const Eigen::VectorXd& u, const InitialStates& initial,
        const Weighting& weighting, const FitOptions& options = {});

/// Fit at `u` without a step: residuals and derivatives only.
Fit linearise(const FitData& data, const FitModel& model, const Eigen::VectorXd& u,
              const InitialStates& initial, const Weighting& weighting);

/// Simulated readings of several robots minus those of the fit's robot, one column per robot. All start from
/// the fit's initial states, and the fit's nuisances are subtracted. A robot that needs shorter integration
/// steps than the fit's is compared with the fit's robot at the same steps.
Eigen::MatrixXd changesTo(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                          const Weighting& weighting);

/// Residuals of each fit's model with other parameters u: a matrix per fit, a column per u. The initial
/// states are adapted to each u, and the fit's nuisances are subtracted. The robots of all fits are simulated
/// in parallel.
std::vector<Eigen::MatrixXd> residualsWith(const FitData& data, const std::vector<WeightedFit>& fits,
                                           const std::vector<std::vector<Eigen::VectorXd>>& parameters);

/// Objectives of the tasks at their starts, with the nuisances of `at` subtracted: infinite where a
/// simulation diverged.
std::vector<double> objectivesAt(const FitData& data, const Fit& at, const std::vector<FitTask>& tasks);

/// Subtracts the best-fitting nuisances from each column of `e`, in place; rows are the data's readings.
void takeOffNuisances(const FitData& data, const Fit& at, const Weighting& weighting,
                      Eigen::Ref<Eigen::MatrixXd> e);

/// Objective of the fit: Σ (w_i e_i)² + Σ (u_k / prior_k)²; infinite if e is not finite.
double objectiveOf(const FitModel& model, const Eigen::VectorXd& u, const Eigen::VectorXd& e,
                   const Weighting& weighting);

/// Weight of each reading, 1 / (s √n) of its sensor, which all recordings share: otherwise the recording that
/// fits best would count most. n is the correlation length of e in samples, and s = max(RMS of e, noise ×
/// √r), where r is the largest ratio RMS / noise of all sensors.
Eigen::VectorXd weightsFor(const FitData& data, const Eigen::VectorXd& e);
/// Weights 1 / (s √n) with s = noise × √r. With weightsFor() a sensor that is fitted badly has a small
/// weight, and the fit can stop in a minimum where it stays so; with these weights it does not.
Eigen::VectorXd noiseWeightsFor(const FitData& data, const Eigen::VectorXd& e);

}  // namespace capstan::diagnosis
