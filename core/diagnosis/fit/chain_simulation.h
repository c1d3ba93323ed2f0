#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/robot/chain/chain_lanes.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/kinematics.h"

namespace capstan::diagnosis {

/// Rows [begin, end) of a recording that are simulated from one initial state.
struct Window {
  std::size_t begin = 0, end = 0;
};

/// What measured and simulated are compared by: numbers in one order, window by window and in a window
/// channel by channel.
struct ComparedChannel {
  std::string name, unit;
  int joint = 0;  ///< from 1; 0: a camera's
  int axis = -1;  ///< of frame 0; −1: a joint encoder's
  double noise = 0.0;
};
struct Compared {
  std::vector<ComparedChannel> channels;
  Eigen::VectorXd measured;
  std::vector<int> channel;               ///< of each number
  std::vector<double> t;                  ///< of each number [s]
  std::vector<std::size_t> window_begin;  ///< first number of each window, and their total at the end
};

/// One robot to simulate.
struct Robot {
  const robot::ChainModel* model = nullptr;
  /// Initial states beyond those of initialStates(), 4n × windows; null: none beyond.
  const Eigen::MatrixXd* initial = nullptr;
};

/// Open-loop simulations of one recording, 16 robots at a time.
/// With cable drives, each segment starts from the joint positions that the joint encoders measured. Without
/// joint encoders it starts from the positions that rigid cables would give, and observations in the first
/// kSettling seconds are not compared. Rigid drives also restart after each `horizon` seconds, from encoders
/// and their slope, since a small torque error grows to a large position error in time. Joint encoders are
/// compared kComparedRate times a second, cameras at every observation.
class ChainSimulation {
 public:
  /// Keeps a reference to `evidence`.
  ChainSimulation(const Evidence& evidence, const robot::Description& robot, double horizon);
  ChainSimulation(const ChainSimulation&) = delete;  // rows_ points into its own columns
  ChainSimulation& operator=(const ChainSimulation&) = delete;

  const Compared& compared() const { return compared_; }
  const std::vector<Window>& windows() const { return windows_; }
  const Evidence& evidence() const { return evidence_; }
  /// q, then dq of each joint at the begin of each window, then how far compliant motors are from where the
  /// slow motion puts them, in position and speed: 4n × windows.
  const Eigen::MatrixXd& initialStates() const { return initial_; }

  /// Simulated sensor readings of each robot, a column each, as Compared::measured. At most 16 robots. NaN
  /// where a simulation ran away.
  void simulate(std::span<const Robot> robots, Eigen::Ref<Eigen::MatrixXd> readings) const {
    simulate(rows_, robots, readings);
  }

  /// The same of one robot, with noise as their sensors have it on loads and on the motors of cable drives.
  void simulateShaken(const Robot& robot, base::Random& random, Eigen::Ref<Eigen::MatrixXd> readings) const;

  /// One robot through whole segments, all rows.
  SimulatedMotion motion(const robot::ChainModel& model) const;

 private:
  using Lanes = std::vector<robot::ChainLane>;  ///< of output k and joint j at k n + j
  void findWindows(double horizon);
  void findInitialStates(const robot::Description& robot);
  void findSamples(const robot::Description& robot);
  robot::ChainShape shapeOf(std::span<const Robot> robots) const;
  int stepsFor(const robot::ChainModel& model) const;
  robot::ChainInput inputAt(std::size_t row, std::size_t next) const;
  robot::ChainState<double> initialState(const robot::ChainModel& model, const Eigen::MatrixXd* beyond,
                                         std::size_t window) const;
  void simulate(const robot::ChainRows& rows, std::span<const Robot> robots,
                Eigen::Ref<Eigen::MatrixXd> readings) const;
  void writeReadings(std::size_t window, std::span<const Robot> robots, const Lanes& q, const Lanes& dq,
                     Eigen::Ref<Eigen::MatrixXd> readings) const;
  Eigen::Vector3d tipAt(double output, std::size_t outputs, std::size_t lane, const Lanes& q,
                        const Lanes& dq) const;

  struct Sample {
    std::size_t number;  ///< in Compared::measured
    std::size_t output;  ///< of the window
    int joint;           ///< from 0
  };
  struct Observation {
    std::size_t number;  ///< of x; y and z are `numbers` and twice that further
    std::size_t stride;
    double output;  ///< of the window, between rows
  };

  const Evidence& evidence_;
  robot::Chain chain_;
  int joints_;
  int stride_ = 1;
  std::vector<Window> windows_;
  Eigen::MatrixXd initial_;
  Compared compared_;
  std::vector<std::vector<Sample>> samples_;            ///< by window
  std::vector<std::vector<Observation>> observations_;  ///< by window
  Columns drive_;               ///< motor torque; of cable drives motor positions, smoothed
  Columns load_, signed_load_;  ///< smoothed; as measured, and with the signs of withSigns()
  robot::ChainRows rows_;
};
inline constexpr double kSettling = 0.5;        ///< [s]
inline constexpr double kComparedRate = 100.0;  ///< [Hz]

/// Restores the sign of loads whose sensor gives only the magnitude: the sign flips where the magnitude comes
/// near zero with a kink, so that the signed load crosses zero smoothly. The first segment keeps its sign.
std::vector<double> withSigns(std::span<const double> magnitude);

}  // namespace capstan::diagnosis
