#include "core/diagnosis/fit/chain_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/diagnosis/fit/start_of_motion.h"
#include "core/robot/chain/chain_state.h"

namespace capstan::diagnosis {
namespace {

using robot::kChainLanes;

constexpr double kLongestStep = 1e-3;         // largest integration step [s]
constexpr double kShortestFreeStep = 0.5e-3;  // least step of rigid drives without contacts [s]
constexpr double kStepError = 0.1;        // RMS change of a rigid drive's readings with half the step, of the
                                          // noise: below it the longer step is short enough
constexpr double kContactStep = 0.25e-3;  // the same where contacts open, cables yield or joints stick [s]
constexpr double kStartStep = 0.125e-3;   // the same at a start: joints at rest against moving motors [s]
constexpr double kStarting = 0.15;        // duration of a start [s]
constexpr double kSticking = 0.5;         // Stribeck excess above which a joint sticks and slips
constexpr double kFastestTurn = 0.7;      // largest phase of the fastest oscillation per step [rad]
constexpr int kMostSteps = 80;            // largest number of integration steps per row
constexpr double kOutputStep = 5e-3;      // time between outputs of the simulation kernel [s]
constexpr double kAfterRestart = 0.12;    // time after a restart in which cameras are not compared: a late
                                          // observation may show the time before the restart [s]
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Whether contacts open, the cable yields, or the joint sticks and slips.
bool isRough(const robot::ChainModel& model, int joint) {
  return (model.shape.laws[joint] & (robot::kLawPlay | robot::kLawSlack | robot::kLawHysteresis)) != 0 ||
         model.numbers.joints[joint].stribeck_excess > kSticking;
}

/// Copies numbers into lane `lane` of a structure of lanes.
template <template <class> class Of>
void put(const Of<double>& from, int lane, Of<robot::ChainLane>& to) {
  constexpr std::size_t kCount = sizeof(Of<double>) / sizeof(double);
  static_assert(sizeof(Of<robot::ChainLane>) == kCount * sizeof(robot::ChainLane));
  const double* numbers = reinterpret_cast<const double*>(&from);
  auto* lanes = reinterpret_cast<robot::ChainLane*>(&to);
  for (std::size_t k = 0; k < kCount; ++k) lanes[k].value[lane] = numbers[k];
}

}  // namespace

ChainSimulation::ChainSimulation(const Evidence& evidence, const robot::Description& robot, double horizon)
    : evidence_(evidence),
      chain_(robot),
      joints_(evidence.joints),
      inputs_(inputsOf(evidence)),
      rows_(inputs_.rows(evidence.t)) {
  stride_ = std::max(1, static_cast<int>(std::lround(kOutputStep / evidence.step)));
  findWindows(evidence.drive == DriveKind::kRigid ? horizon : 0.0);
  findInitialStates(robot);
  findSamples(robot);
  if (evidence.drive == DriveKind::kRigid) findFreeSteps(robot);
}

void ChainSimulation::findFreeSteps(const robot::Description& robot) {
  const robot::ChainModel nominal(robot);
  const auto readingsWith = [&](int steps) {
    free_steps_ = steps;
    Eigen::MatrixXd readings(compared_.measured.size(), 1);
    const Robot one{&nominal};
    simulate({&one, 1}, readings);
    return readings;
  };
  const int most = std::max(1, static_cast<int>(std::ceil(evidence_.step / kShortestFreeStep - 1e-9)));
  if (most == 1) return;
  Eigen::MatrixXd coarse = readingsWith(1);
  for (int steps = 1; steps < most; steps *= 2) {
    Eigen::MatrixXd fine = readingsWith(2 * steps);
    if (largestChange(coarse, fine) < kStepError) {
      free_steps_ = steps;
      return;
    }
    coarse.swap(fine);
  }
  free_steps_ = most;
}

double ChainSimulation::largestChange(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) const {
  std::vector<double> squares(compared_.channels.size()), count(compared_.channels.size());
  for (std::size_t i = 0; i < compared_.channel.size(); ++i) {
    const auto c = static_cast<std::size_t>(compared_.channel[i]);
    const auto at = static_cast<Eigen::Index>(i);
    squares[c] += std::pow((to(at, 0) - from(at, 0)) / compared_.channels[c].noise, 2);
    count[c] += 1.0;
  }
  double largest = 0.0;
  for (std::size_t c = 0; c < squares.size(); ++c) {
    if (std::isnan(squares[c])) return squares[c];
    if (count[c] > 0.0) largest = std::max(largest, squares[c] / count[c]);
  }
  return std::sqrt(largest);
}

void ChainSimulation::findWindows(double horizon) {
  constexpr std::size_t kLeastWindow = 50;  // fewest rows per window, which matters at low sampling rates
  const auto most =
      horizon > 0.0 ? std::max(kLeastWindow, static_cast<std::size_t>(std::lround(horizon / evidence_.step)))
                    : std::numeric_limits<std::size_t>::max() / 2;
  for (const Segment& segment : evidence_.segments) {
    const std::size_t pieces = std::max<std::size_t>(1, (segment.size() + most / 2) / most);
    for (std::size_t k = 0; k < pieces; ++k)
      windows_.push_back(
          {segment.begin + k * segment.size() / pieces, segment.begin + (k + 1) * segment.size() / pieces});
  }
}

void ChainSimulation::findInitialStates(const robot::Description& robot) {
  const bool rigid = evidence_.drive == DriveKind::kRigid;
  initial_.setZero(4 * joints_, static_cast<Eigen::Index>(windows_.size()));
  const robot::ChainModel nominal(robot);
  const auto reach = std::max<std::size_t>(4, static_cast<std::size_t>(0.02 / evidence_.step));
  const bool whole = rigid && windows_.size() == evidence_.segments.size();
  const auto startOf = whole ? parabolaFrom : lineAround;
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const Window& window = windows_[w];
    robot::JointVector q_m = robot::JointVector::Zero(joints_);
    for (int j = 0; j < joints_ && !rigid; ++j)
      q_m[j] = evidence_.q_m[static_cast<std::size_t>(j)][window.begin];
    const robot::JointVector from_motors = robot::jointsFromMotors(nominal, q_m);
    for (int j = 0; j < joints_; ++j) {
      std::pair<double, double> line{kNothing, 0.0};
      if (evidence_.hasEncoders())
        line = startOf(evidence_.q[static_cast<std::size_t>(j)], window.begin,
                       std::min(window.end, window.begin + reach), evidence_.step);
      if (!std::isfinite(line.first)) line.first = rigid ? nominal.shape.middle[j] : from_motors[j];
      const auto at = static_cast<Eigen::Index>(w);
      initial_(j, at) = line.first;
      initial_(joints_ + j, at) = rigid ? line.second : 0.0;
    }
  }
}

void ChainSimulation::findSamples(const robot::Description& robot) {
  const Evidence& e = evidence_;
  std::vector<int> encoder_channel(static_cast<std::size_t>(joints_), -1);
  for (int j = 0; j < joints_ && e.hasEncoders(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    const bool turns = robot.joints[at].type == robot::JointType::kRevolute;
    encoder_channel[at] = static_cast<int>(compared_.channels.size());
    compared_.channels.push_back(
        {"q" + std::to_string(j + 1), turns ? "rad" : "m", j + 1, -1, e.noise.q[at].floor()});
  }
  const int first_tip = static_cast<int>(compared_.channels.size());
  for (int axis = 0; axis < 3 && e.hasCameras(); ++axis)
    compared_.channels.push_back({std::string("tip ") + "xyz"[axis], "m", 0, axis,
                                  e.noise.tip[static_cast<std::size_t>(axis)].floor()});
  const int thin = std::max(1, static_cast<int>(std::lround(1.0 / (kComparedRate * e.step * stride_))));
  const double skip = e.hasEncoders() ? 0.0 : kSettling;
  std::vector<double> measured;
  const auto add = [&](int channel, double t, double value) {
    compared_.channel.push_back(channel);
    compared_.t.push_back(t);
    measured.push_back(value);
    return measured.size() - 1;
  };
  for (const Window& window : windows_) {
    compared_.window_begin.push_back(measured.size());
    samples_.emplace_back();
    observations_.emplace_back();
    const std::size_t outputs = (window.end - window.begin - 1) / static_cast<std::size_t>(stride_) + 1;
    for (int j = 0; j < joints_ && e.hasEncoders(); ++j)
      for (std::size_t k = 0; k < outputs; k += static_cast<std::size_t>(thin)) {
        const std::size_t row = window.begin + k * static_cast<std::size_t>(stride_);
        const double q = e.q[static_cast<std::size_t>(j)][row];
        if (!e.counts(row) || !std::isfinite(q)) continue;
        const std::size_t number = add(encoder_channel[static_cast<std::size_t>(j)], e.t[row], q);
        samples_.back().push_back({number, k, j});
      }
    std::vector<const TipObservation*> seen;
    const bool restarts = windows_.size() > e.segments.size();
    const double from =
        std::max(skip, restarts ? kAfterRestart : 0.0) / e.step + static_cast<double>(window.begin);
    for (const TipObservation& observation : e.tip)
      if (observation.counts && observation.row >= from &&
          observation.row <= static_cast<double>(window.end - 1))
        seen.push_back(&observation);
    const std::size_t first = measured.size();
    for (int axis = 0; axis < 3; ++axis)
      for (const TipObservation* observation : seen)
        add(first_tip + axis, observation->t, observation->position[axis]);
    for (std::size_t k = 0; k < seen.size(); ++k)
      observations_.back().push_back(
          {first + k, seen.size(), (seen[k]->row - static_cast<double>(window.begin)) / stride_});
  }
  compared_.window_begin.push_back(measured.size());
  compared_.measured =
      Eigen::Map<Eigen::VectorXd>(measured.data(), static_cast<Eigen::Index>(measured.size()));
}

robot::ChainShape ChainSimulation::shapeOf(std::span<const Robot> robots) const {
  robot::ChainShape shape = robots.front().model->shape;
  for (const Robot& robot : robots)
    for (int j = 0; j < joints_; ++j) shape.laws[j] |= robot.model->shape.laws[j];
  return shape;
}

int ChainSimulation::stepsFor(const robot::ChainModel& model) const {
  double rate = model.shape.rigid ? free_steps_ / evidence_.step : 1.0 / kLongestStep;
  for (int j = 0; j < joints_; ++j)
    if (isRough(model, j)) rate = 1.0 / kContactStep;
  for (const double share : {-0.5, 0.0, 0.5}) {
    robot::JointVector q(joints_);
    for (int j = 0; j < joints_; ++j)
      q[j] = model.shape.middle[j] + share / model.shape.inverse_half_range[j];
    rate = std::max(rate, robot::chainOscillation(model, q) / kFastestTurn);
  }
  return std::isfinite(rate)
             ? std::clamp(static_cast<int>(std::ceil(evidence_.step * rate - 1e-9)), 1, kMostSteps)
             : kMostSteps;
}

robot::ChainState<double> ChainSimulation::initialState(const robot::ChainModel& model,
                                                        const Eigen::MatrixXd* beyond,
                                                        std::size_t window) const {
  const auto at = static_cast<Eigen::Index>(window);
  robot::JointVector q(joints_), dq(joints_), q_m(joints_);
  for (int j = 0; j < joints_; ++j) {
    q[j] = initial_(j, at) + (beyond ? (*beyond)(j, at) : 0.0);
    dq[j] = initial_(joints_ + j, at) + (beyond ? (*beyond)(joints_ + j, at) : 0.0);
    q_m[j] = rows_.drive[j][windows_[window].begin];
  }
  if (!evidence_.hasEncoders() && !model.shape.rigid) q = robot::jointsFromMotors(model, q_m);
  robot::ChainState<double> state = robot::stateAt(model, q, dq);
  if (model.shape.rigid) robot::windUp(model, inputAt(windows_[window].begin, windows_[window].begin), state);
  for (int j = 0; j < joints_; ++j) {
    const robot::JointNumbers<double>& p = model.numbers.joints[j];
    state.motor[j] += beyond ? (*beyond)(2 * joints_ + j, at) : 0.0;
    state.motor_rate[j] += beyond ? (*beyond)(3 * joints_ + j, at) : 0.0;
    if (model.shape.laws[j] & robot::kLawCreep)
      state.creep[j] =
          p.creep_begun * p.creep_share / (1.0 + p.creep_share) * robot::stretchAt(model, j, q_m[j], q);
  }
  return state;
}

std::size_t ChainSimulation::outputsOf(const Window& window) const {
  return (window.end - window.begin - 1) / static_cast<std::size_t>(stride_) + 1;
}

int ChainSimulation::startingSteps() const {
  return std::min(kMostSteps, static_cast<int>(std::ceil(evidence_.step / kStartStep - 1e-9)));
}

std::size_t ChainSimulation::startingOutputs(const Window& window) const {
  if (evidence_.drive == DriveKind::kRigid) return 0;
  const auto first = static_cast<std::size_t>(kStarting / (evidence_.step * stride_));
  return first < outputsOf(window) ? first : 0;
}

void ChainSimulation::simulate(const robot::ChainRows& rows, std::span<const Robot> robots,
                               Eigen::Ref<Eigen::MatrixXd> readings) const {
  static const robot::SimulateChain kernel = robot::simulateChainKernel();
  const robot::ChainShape shape = shapeOf(robots);
  const auto numbers = std::make_unique<robot::ChainNumbers<robot::ChainLane>>();
  const auto state = std::make_unique<robot::ChainState<robot::ChainLane>>();
  robot::ChainRun run;
  run.stride = stride_;
  for (int lane = 0; lane < kChainLanes; ++lane) {
    const Robot& robot = robots[std::min<std::size_t>(static_cast<std::size_t>(lane), robots.size() - 1)];
    put<robot::ChainNumbers>(robot.model->numbers, lane, *numbers);
    run.steps = std::max({run.steps, robot.steps, stepsFor(*robot.model)});
  }
  Lanes q, dq;
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    for (int lane = 0; lane < kChainLanes; ++lane) {
      const Robot& robot = robots[std::min<std::size_t>(static_cast<std::size_t>(lane), robots.size() - 1)];
      put<robot::ChainState>(initialState(*robot.model, robot.initial, w), lane, *state);
    }
    const std::size_t count = outputsOf(windows_[w]) * static_cast<std::size_t>(joints_);
    if (q.size() < count) q.resize(count), dq.resize(count);
    run.begin = windows_[w].begin;
    run.end = windows_[w].end;
    const std::size_t first = startingOutputs(windows_[w]);
    if (first > 0) {
      robot::ChainRun begin = run;
      begin.end = run.begin + first * static_cast<std::size_t>(stride_) + 1;
      begin.steps = std::max(run.steps, startingSteps());
      begin.q = q.front().value, begin.dq = dq.front().value;
      kernel(shape, *numbers, rows, begin, *state);
      run.begin = begin.end - 1;
    }
    const std::size_t next = first * static_cast<std::size_t>(joints_);
    run.q = q[next].value, run.dq = dq[next].value;
    kernel(shape, *numbers, rows, run, *state);
    writeReadings(w, robots, q, dq, readings);
  }
}

void ChainSimulation::writeReadings(std::size_t window, std::span<const Robot> robots, const Lanes& q,
                                    const Lanes& dq, Eigen::Ref<Eigen::MatrixXd> readings) const {
  const std::size_t outputs = outputsOf(windows_[window]);
  for (std::size_t lane = 0; lane < robots.size(); ++lane) {
    const auto column = static_cast<Eigen::Index>(lane);
    for (const Sample& sample : samples_[window])
      readings(static_cast<Eigen::Index>(sample.number), column) =
          q[sample.output * static_cast<std::size_t>(joints_) + static_cast<std::size_t>(sample.joint)]
              .value[lane];
    const robot::CameraNumbers& camera = robots[lane].model->camera;
    const double late = camera.delay / (evidence_.step * stride_);
    for (const Observation& observation : observations_[window]) {
      const Eigen::Vector3d tip = camera.measure(tipAt(observation.output - late, outputs, lane, q, dq));
      for (std::size_t axis = 0; axis < 3; ++axis)
        readings(static_cast<Eigen::Index>(observation.number + axis * observation.stride), column) =
            tip[static_cast<Eigen::Index>(axis)];
    }
  }
}

Eigen::Vector3d ChainSimulation::tipAt(double output, std::size_t outputs, std::size_t lane, const Lanes& q,
                                       const Lanes& dq) const {
  const double x = std::clamp(output, 0.0, static_cast<double>(outputs - 1));
  const auto k = std::min(static_cast<std::size_t>(x), outputs >= 2 ? outputs - 2 : 0);
  const double s = outputs >= 2 ? x - static_cast<double>(k) : 0.0, h = evidence_.step * stride_;
  const double s2 = s * s, s3 = s2 * s;
  robot::JointVector at(joints_);
  for (int j = 0; j < joints_; ++j) {  // cubic Hermite interpolation
    const std::size_t here = k * static_cast<std::size_t>(joints_) + static_cast<std::size_t>(j);
    const std::size_t next = outputs >= 2 ? here + static_cast<std::size_t>(joints_) : here;
    at[j] = (2 * s3 - 3 * s2 + 1) * q[here].value[lane] + (s3 - 2 * s2 + s) * h * dq[here].value[lane] +
            (3 * s2 - 2 * s3) * q[next].value[lane] + (s3 - s2) * h * dq[next].value[lane];
  }
  return chain_.marker(at);
}

robot::ChainInput ChainSimulation::inputAt(std::size_t row, std::size_t next) const {
  robot::ChainInput input;
  input.t = evidence_.t[row];
  input.dt = next > row ? evidence_.t[next] - evidence_.t[row] : evidence_.step;
  for (int j = 0; j < joints_; ++j) {
    input.torque[j] = input.motor[j] = rows_.drive[j][row];
    input.motor_end[j] = rows_.drive[j][next];
    input.load[j] = rows_.load[j] ? rows_.load[j][row] : 0.0;
    input.signed_load[j] = rows_.signed_load[j] ? rows_.signed_load[j][row] : input.load[j];
  }
  return input;
}

}  // namespace capstan::diagnosis
