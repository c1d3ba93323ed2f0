#include "core/tracking/extended_arm_model.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/robot/chain/chain_law.h"
#include "core/robot/fold_effects.h"

namespace capstan::tracking {
namespace {

using robot::ChainLane;
using robot::ChainNumbers;
using robot::ChainState;
using robot::kChainLanes;

static_assert(ExtendedArmModel::Points::ColsAtCompileTime == kChainLanes);

ChainNumbers<ChainLane> sameInAllLanes(const ChainNumbers<double>& numbers) {
  constexpr std::size_t kCount = sizeof(numbers) / sizeof(double);
  double values[kCount];
  std::memcpy(values, &numbers, sizeof(numbers));
  ChainNumbers<ChainLane> lanes;
  static_assert(sizeof(lanes) == kCount * sizeof(ChainLane));
  auto* lane = reinterpret_cast<ChainLane*>(&lanes);
  for (std::size_t i = 0; i < kCount; ++i) std::fill_n(lane[i].value, kChainLanes, values[i]);
  return lanes;
}

double largestWithinLimits(const robot::ChainModel& model, const robot::Description& robot,
                           double (*rateOf)(const robot::ChainModel&, const robot::JointVector&)) {
  constexpr int kGrid = 6;
  double rate = 0.0;
  robot::JointVector q(3);
  q[0] = robot.joints[0].limit_low;  // M does not depend on q1
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const auto at = [&](std::size_t joint, int k) {
        const robot::Joint& of = robot.joints[joint];
        return of.limit_low + (of.limit_high - of.limit_low) * k / kGrid;
      };
      q[1] = at(1, i), q[2] = at(2, j);
      rate = std::max(rate, rateOf(model, q));
    }
  return rate;
}

}  // namespace

bool ExtendedArmModel::isNeededFor(const robot::Description& robot) {
  const std::vector<robot::Effect> left = robot::foldEffects(robot).effects;
  return std::ranges::any_of(left, [](const robot::Effect& effect) {
    return robot::lawOf(effect.effect) != 0 || effect.effect == "inertia" || effect.effect == "payload";
  });
}

ExtendedArmModel::ExtendedArmModel(const robot::Description& robot, const double (&low)[6],
                                   const double (&high)[6], math::InstructionSet set)
    : model_(robot), lanes_(sameInAllLanes(model_.numbers)), kernel_(robot::simulateChainKernel(set)) {
  std::ranges::copy(low, low_);
  std::ranges::copy(high, high_);
  for (int i = 0; i < 3; ++i) {
    model_.shape.laws[i] &=
        ~(robot::kLawSlip | robot::kLawZeroDrift);  // matters of the reading (MotorReading)
    model_.shape.farthest[i] =
        std::max(high[2 * i] - model_.shape.middle[i], model_.shape.middle[i] - low[2 * i]);
    model_.shape.fastest[i] = high[2 * i + 1];
    has_memory_ |= (model_.shape.laws[i] & (robot::kLawHysteresis | robot::kLawCreep)) != 0;
  }
  rate_ = largestWithinLimits(model_, robot, robot::chainRate);
  oscillation_ = largestWithinLimits(model_, robot, robot::chainOscillation);
}

/// Integrates in rows of 1 ms; within a row the arm's mass matrix is constant.
void ExtendedArmModel::run(ChainState<ChainLane>& state, const CableArmDrive& drive, double dt) const {
  constexpr double kRow = 1e-3;     // [s]
  constexpr double kMost = 1000.0;  // a gap in the samples must not stall the pipeline
  const int rows = static_cast<int>(std::clamp(std::ceil(dt / kRow), 1.0, kMost));
  const double step = dt / rows;
  robot::ChainRun run;
  run.end = 2, run.stride = 2;
  run.steps = std::max(1, static_cast<int>(std::ceil(oscillation_ * step / 0.7)));
  ChainLane q[3], dq[3];  // output of the first row: ignored
  run.q = q[0].value, run.dq = dq[0].value;
  for (int row = 0; row < rows; ++row) {
    const double t[2] = {row * step, (row + 1) * step};
    double motors[3][2];
    robot::ChainRows driven;
    driven.t = t;
    for (int i = 0; i < 3; ++i) {
      const double way = (drive.position1[i] - drive.position0[i]) / rows;
      motors[i][0] = drive.position0[i] + row * way, motors[i][1] = motors[i][0] + way;
      driven.drive[i] = motors[i];
    }
    kernel_(model_.shape, lanes_, driven, run, state);
  }
}

void ExtendedArmModel::propagate(Points& points, const CableArmDrive& drive, const CableMemory& memory,
                                 double dt) const {
  ChainState<ChainLane> state{};
  for (int i = 0; i < 3; ++i)
    for (int lane = 0; lane < kChainLanes; ++lane) {
      state.q[i].value[lane] = std::clamp(points(2 * i, lane), low_[2 * i], high_[2 * i]);
      state.dq[i].value[lane] = std::clamp(points(2 * i + 1, lane), low_[2 * i + 1], high_[2 * i + 1]);
      state.hysteresis[i].value[lane] = memory.hysteresis[i];
      state.creep[i].value[lane] = memory.creep[i];
    }
  run(state, drive, dt);
  for (int i = 0; i < 3; ++i)
    for (int lane = 0; lane < kChainLanes; ++lane) {
      points(2 * i, lane) = state.q[i].value[lane];
      points(2 * i + 1, lane) = state.dq[i].value[lane];
    }
}

CableMemory ExtendedArmModel::remember(const Eigen::Matrix<double, 6, 1>& x, const CableArmDrive& drive,
                                       const CableMemory& memory, double dt) const {
  if (!has_memory_) return memory;
  ChainState<ChainLane> state{};
  for (int i = 0; i < 3; ++i) {
    std::fill_n(state.q[i].value, kChainLanes, std::clamp(x[2 * i], low_[2 * i], high_[2 * i]));
    std::fill_n(state.dq[i].value, kChainLanes, std::clamp(x[2 * i + 1], low_[2 * i + 1], high_[2 * i + 1]));
    std::fill_n(state.hysteresis[i].value, kChainLanes, memory.hysteresis[i]);
    std::fill_n(state.creep[i].value, kChainLanes, memory.creep[i]);
  }
  run(state, drive, dt);
  CableMemory after;
  for (int i = 0; i < 3; ++i) {
    after.hysteresis[i] = state.hysteresis[i].value[0];
    after.creep[i] = state.creep[i].value[0];
  }
  return after;
}

double ExtendedArmModel::tension(int joint, double stretch, double rate, double q,
                                 const CableMemory& memory) const {
  const robot::ChainShape& shape = model_.shape;
  const double range = (q - shape.middle[joint]) * shape.inverse_half_range[joint];
  return robot::cablePull(model_.numbers.joints[joint], shape.laws[joint], stretch, rate, range,
                          memory.hysteresis[joint], memory.creep[joint])
      .force;
}

}  // namespace capstan::tracking
