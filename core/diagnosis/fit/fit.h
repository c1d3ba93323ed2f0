#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/evidence/encoder_zeros.h"
#include "core/diagnosis/fit/chain_simulation.h"
#include "core/diagnosis/fit/fit_model.h"

namespace capstan::diagnosis {

/// Initial states beyond those of each recording's simulation: by recording, 4n × windows.
using InitialStates = std::vector<Eigen::MatrixXd>;

/// All recordings of one robot, and how their numbers stack: recording by recording, each as its Compared.
class FitData {
 public:
  FitData(const std::vector<Evidence>& recordings, const robot::Description& robot, double horizon,
          EncoderZeros zeros, int threads);

  int recordings() const { return static_cast<int>(simulations_.size()); }
  const ChainSimulation& simulation(int r) const { return *simulations_[static_cast<std::size_t>(r)]; }
  Eigen::Index size() const { return measured_.size(); }
  Eigen::Index first(int r) const { return first_[static_cast<std::size_t>(r)]; }
  const Eigen::VectorXd& measured() const { return measured_; }
  int threads() const { return threads_; }
  bool rigid() const { return rigid_; }
  bool zerosFree() const { return zeros_ != EncoderZeros::kKnown; }  ///< of joint encoders

  /// Sensor channels of all recordings, in order; channel()[i] is that of number i.
  const std::vector<ComparedChannel>& channels() const { return channels_; }
  const std::vector<int>& channel() const { return channel_; }
  /// Blocks of time, about kBlock seconds, of rigid drives their windows: what cross-validation and bootstrap
  /// exclude and draw. block()[i] is that of number i.
  int blocks() const { return blocks_; }
  const std::vector<int>& block() const { return block_; }
  /// Stretches that have nuisances of their own (initial states of rigid drives; encoder zeros of a
  /// recording, or of all): numbers [begin, end) of each.
  const std::vector<std::pair<Eigen::Index, Eigen::Index>>& segments() const { return segments_; }

  /// Simulated readings of the robots of several models, a column each. `initial`: of each robot; empty: none
  /// beyond the simulations' own.
  Eigen::MatrixXd simulate(const std::vector<robot::ChainModel>& models,
                           const std::vector<InitialStates>& initial = {}) const;

 private:
  void stack(const ChainSimulation& simulation);

  std::vector<std::unique_ptr<ChainSimulation>> simulations_;
  std::vector<Eigen::Index> first_;
  Eigen::VectorXd measured_;
  std::vector<ComparedChannel> channels_;
  std::vector<int> channel_, block_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> segments_;
  int blocks_ = 0, threads_ = 1;
  bool rigid_ = false;
  EncoderZeros zeros_ = EncoderZeros::kKnown;
};
inline constexpr double kBlock = 1.0;  ///< [s]

InitialStates noneBeyond(const FitData& data);

/// Where a fit stands, and its linearisation.
struct Fit {
  FitModel model;
  Eigen::VectorXd u = {};
  InitialStates initial = {};
  Eigen::VectorXd e = {};         ///< measured − simulated, nuisances taken off
  Eigen::MatrixXd jacobian = {};  ///< d simulated / du, nuisances taken off; columns of `model`
  Eigen::MatrixXd nuisance = {};  ///< d simulated / d nuisance of the number's own stretch
  std::vector<Eigen::MatrixXd> removed =
      {};                        ///< by segment: change of the nuisances that best compensates a change of u
  std::vector<bool> bound = {};  ///< parameters that stand at a bound and would go on
  double objective = 0.0;        ///< of e
  int iterations = 0;
};

/// How numbers count in a fit.
struct Weighting {
  Eigen::VectorXd weights;  ///< 1 / standard deviation of each number
};

struct FitOptions {
  int iterations = 12;
  double tolerance = 0.1;  ///< fall of the objective that counts as standing still
  /// Cable drives: derivatives by the parameters that this fit has as well are taken from there instead of
  /// again: coarser and faster, for a first ranking.
  const Fit* known = nullptr;
};

/// Least squares on the simulation error with priors,
///     Σ (w_i e_i)² + Σ (u_k / prior_k)²:
/// Gauss–Newton on forward differences, 16 robots side by side; each step is tried in several dampings and
/// lengths at once (Levenberg–Marquardt) and kept inside the bounds. Encoder zeros are solved for in
/// each segment. Initial states of rigid drives are solved for in each segment too: the linearised step is
/// tried at several fractions of its length, and each trial is judged by a simulation, because static
/// friction is strongly nonlinear. Ends early, with the estimate so far, when `progress` is cancelled.
Fit fit(const FitData& data, const FitModel& model, const Eigen::VectorXd& u, const InitialStates& initial,
        const Weighting& weighting, const FitOptions& options = {}, const base::Progress* progress = nullptr);

/// Residuals and derivatives at `u` without a step.
Fit linearise(const FitData& data, const FitModel& model, const Eigen::VectorXd& u,
              const InitialStates& initial, const Weighting& weighting);

/// Measured less the simulated readings of each of `robots`, a column each, from the fit's initial states and
/// with its nuisances taken off.
Eigen::MatrixXd residualsOf(const FitData& data, const Fit& at, const std::vector<robot::ChainModel>& robots,
                            const Weighting& weighting);

/// Likewise of the fit's own model with other numbers u, from initial states that follow them.
Eigen::MatrixXd residualsWith(const FitData& data, const Fit& at, const std::vector<Eigen::VectorXd>& numbers,
                              const Weighting& weighting);

/// Takes the fit's nuisances off the columns of `e`, numbers as the data's.
void takeOffNuisances(const FitData& data, const Fit& at, const Weighting& weighting,
                      Eigen::Ref<Eigen::MatrixXd> e);

/// Σ (w e)² and priors.
double objectiveOf(const FitModel& model, const Eigen::VectorXd& u, const Eigen::VectorXd& e,
                   const Weighting& weighting);

/// Weight of each number: 1 / (max(noise, RMS of e) √n) of its channel, where n is the correlation length of
/// e in samples.
Eigen::VectorXd weightsFor(const FitData& data, const Eigen::VectorXd& e);

}  // namespace capstan::diagnosis
