#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/fit/simulation_inputs.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/robot/chain/chain_lanes.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/kinematics.h"

namespace capstan::diagnosis {

/// Rows [begin, end) of a recording that are simulated from one initial state.
struct Window {
  std::size_t begin = 0, end = 0;
};

/// One sensor channel in the comparison of measured and simulated.
struct ComparedChannel {
  std::string name, unit;
  int joint = 0;       ///< joint of the encoder, from 1; 0: a camera channel
  int axis = -1;       ///< axis of frame 0, from 0; −1: a joint encoder
  double noise = 0.0;  ///< noise floor, ChannelNoise::floor()
};
/// Readings at which measurement and simulation are compared. They are ordered window by window, and within a
/// window channel by channel.
struct Compared {
  std::vector<ComparedChannel> channels;
  Eigen::VectorXd measured;
  std::vector<int> channel;               ///< channel of each reading
  std::vector<double> t;                  ///< time of each reading [s]
  std::vector<std::size_t> window_begin;  ///< first reading of each window, then the number of readings
};

/// One robot to simulate, and its initial states.
struct Robot {
  const robot::ChainModel* model = nullptr;
  /// Offsets that are added to initialStates(), 4n × windows; null: no offsets.
  const Eigen::MatrixXd* initial = nullptr;
  int steps = 1;  ///< number of integration steps per row; raised to stepsFor() if smaller
};

/// Open-loop simulations of a robot model on the recorded inputs of one recording (motor positions of cable
/// drives, motor torques of rigid drives, loads), 16 robots at a time.
/// With cable drives, each segment starts from the joint positions that the joint encoders measured. Without
/// joint encoders it starts from the positions that rigid cables would give, and observations in the first
/// kSettling seconds are not compared. Rigid drives also restart after each `horizon` seconds from the
/// encoders and their slope, because a small torque error grows to a large position error over time; with
/// `horizon` 0 they restart at segments only. Joint encoders are compared at kComparedRate, cameras at every
/// observation.
class ChainSimulation {
 public:
  /// Keeps a reference to `evidence`.
  ChainSimulation(const Evidence& evidence, const robot::Description& robot, double horizon);
  ChainSimulation(const ChainSimulation&) = delete;  // rows_ points into its own columns
  ChainSimulation& operator=(const ChainSimulation&) = delete;

  const Compared& compared() const { return compared_; }
  const std::vector<Window>& windows() const { return windows_; }
  const Evidence& evidence() const { return evidence_; }
  /// Initial states, 4n × windows: q and dq of the joints, then the deviations in position and speed of
  /// compliant motors from their quasi-static state.
  const Eigen::MatrixXd& initialStates() const { return initial_; }

  /// Number of integration steps per row that a robot needs.
  int stepsFor(const robot::ChainModel& model) const;

  /// Simulates at most 16 robots, with the largest of their numbers of steps: one column of readings per
  /// robot, in the order of Compared::measured. NaN where a simulation diverged.
  void simulate(std::span<const Robot> robots, Eigen::Ref<Eigen::MatrixXd> readings) const {
    simulate(rows_, robots, readings);
  }

  /// Inputs of simulate().
  const SimulationInputs& inputs() const { return inputs_; }
  /// Simulates one robot with other inputs.
  void simulateWith(const SimulationInputs& inputs, const Robot& robot,
                    Eigen::Ref<Eigen::MatrixXd> readings) const {
    simulate(inputs.rows(evidence_.t), {&robot, 1}, readings);
  }

  /// Simulates one robot through whole segments, without restarts at windows, on all rows.
  SimulatedMotion motion(const robot::ChainModel& model) const;

 private:
  using Lanes = std::vector<robot::ChainLane>;  ///< output k of joint j is at index k n + j
  void findWindows(double horizon);
  void findInitialStates(const robot::Description& robot);
  void findSamples(const robot::Description& robot);
  /// Chooses the integration steps per row of rigid drives: as few as change the readings of the nominal
  /// robot by little (kStepError), and not more than steps of kShortestFreeStep.
  void findFreeSteps(const robot::Description& robot);
  /// Largest RMS change of a channel, in units of its noise; NaN if a simulation diverged.
  double largestChange(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) const;
  robot::ChainShape shapeOf(std::span<const Robot> robots) const;
  robot::ChainInput inputAt(std::size_t row, std::size_t next) const;
  robot::ChainState<double> initialState(const robot::ChainModel& model, const Eigen::MatrixXd* beyond,
                                         std::size_t window) const;
  std::size_t outputsOf(const Window& window) const;
  /// Number of outputs in the first kStarting seconds of a window of a cable drive, which are simulated with
  /// startingSteps() per row or more; 0 if the window is shorter.
  std::size_t startingOutputs(const Window& window) const;
  int startingSteps() const;
  void simulate(const robot::ChainRows& rows, std::span<const Robot> robots,
                Eigen::Ref<Eigen::MatrixXd> readings) const;
  void writeReadings(std::size_t window, std::span<const Robot> robots, const Lanes& q, const Lanes& dq,
                     Eigen::Ref<Eigen::MatrixXd> readings) const;
  Eigen::Vector3d tipAt(double output, std::size_t outputs, std::size_t lane, const Lanes& q,
                        const Lanes& dq) const;

  struct Sample {
    std::size_t number;  ///< index in Compared::measured
    std::size_t output;  ///< index of the window's output
    int joint;           ///< joint, from 0
  };
  struct Observation {
    std::size_t number;  ///< index of x in Compared::measured
    std::size_t stride;  ///< distance from x to y, and from y to z, in Compared::measured
    double output;       ///< position among the window's outputs
  };

  const Evidence& evidence_;
  robot::Chain chain_;
  int joints_;
  int stride_ = 1;
  int free_steps_ = 1;  ///< integration steps per row of a rigid drive without contacts
  std::vector<Window> windows_;
  Eigen::MatrixXd initial_;
  Compared compared_;
  std::vector<std::vector<Sample>> samples_;            ///< one list per window
  std::vector<std::vector<Observation>> observations_;  ///< one list per window
  SimulationInputs inputs_;
  robot::ChainRows rows_;  ///< of inputs_
};
inline constexpr double kSettling = 0.5;        ///< time that is not compared at a start without encoders [s]
inline constexpr double kComparedRate = 100.0;  ///< rate at which joint encoders are compared [Hz]

/// Restores the sign of a load whose sensor measures only the magnitude. The sign flips at the minimum of
/// each approach to zero, and the load is positive up to the first one. Fewer than 20 samples are returned as
/// they are.
std::vector<double> withSigns(std::span<const double> magnitude);

}  // namespace capstan::diagnosis
