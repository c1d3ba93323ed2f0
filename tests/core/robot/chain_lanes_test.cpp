// Kernels of every instruction set against the same step in double, robot by robot, with all laws at work.
#include "core/robot/chain/chain_lanes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/robot/chain/chain_step.h"
#include "tests/core/robot/driven_chains.h"

namespace capstan::robot {
namespace {

constexpr std::size_t kRows = 1001;

struct Lanes {
  ChainNumbers<ChainLane> numbers;
  ChainState<ChainLane> state;

  template <template <class> class Of>
  static void put(const Of<double>& from, int lane, Of<ChainLane>& to) {
    constexpr std::size_t kCount = sizeof(Of<double>) / sizeof(double);
    double values[kCount];
    std::memcpy(values, &from, sizeof(values));
    auto* lanes = reinterpret_cast<ChainLane*>(&to);
    for (std::size_t i = 0; i < kCount; ++i) lanes[i].value[lane] = values[i];
  }
};

/// Sixteen robots of one shape: all effects grow from lane to lane.
std::vector<ChainModel> family(const Description& robot) {
  std::vector<ChainModel> models;
  for (int lane = 0; lane < kChainLanes; ++lane) {
    Description grown = robot;
    for (Effect& effect : grown.effects)
      for (EffectValue& value : effect.values)
        if (value.parameter != "time") value.value *= 1.0 + 0.03 * lane;
    models.emplace_back(grown);
  }
  return models;
}

struct Moved {
  std::vector<ChainLane> q, dq;  ///< one an output and joint
  ChainState<ChainLane> state;
};

Moved runLanes(math::InstructionSet set, const std::vector<ChainModel>& models,
               const testing::DrivenRows& rows, int steps, int stride) {
  Lanes lanes{};
  for (int lane = 0; lane < kChainLanes; ++lane) {
    const ChainModel& model = models[static_cast<std::size_t>(lane)];
    const ChainState<double> state = stateAt(model, rows.start(model), JointVector::Zero(model.shape.joints));
    Lanes::put<ChainNumbers>(model.numbers, lane, lanes.numbers);
    Lanes::put<ChainState>(state, lane, lanes.state);
  }
  const auto n = static_cast<std::size_t>(models[0].shape.joints);
  const std::size_t outputs = (rows.t.size() - 1) / static_cast<std::size_t>(stride) + 1;
  Moved result;
  result.q.resize(outputs * n), result.dq = result.q;
  simulateChainKernel(set)(models[0].shape, lanes.numbers, rows.view(),
                           {0, rows.t.size(), steps, stride, result.q.data()->value, result.dq.data()->value},
                           lanes.state);
  result.state = lanes.state;
  return result;
}

double laneOf(const std::vector<ChainLane>& column, std::size_t row, std::size_t n, std::size_t joint,
              int lane) {
  return column[row * n + joint].value[lane];
}

class KernelOf : public ::testing::TestWithParam<std::tuple<math::InstructionSet, int, DriveType>> {
 protected:
  void SetUp() override {
    if (!math::isAvailable(set())) GTEST_SKIP() << "this processor lacks " << math::nameOf(set());
  }
  math::InstructionSet set() const { return std::get<0>(GetParam()); }
  Description robot() const {
    base::Random random(static_cast<std::uint64_t>(50 + std::get<1>(GetParam())));
    return testing::withEveryLaw(
        testing::drivenRobot(random, std::get<1>(GetParam()), std::get<2>(GetParam())));
  }
};

INSTANTIATE_TEST_SUITE_P(Sets, KernelOf,
                         ::testing::Combine(::testing::ValuesIn(math::kInstructionSets),
                                            ::testing::Values(1, 3, 7),
                                            ::testing::Values(DriveType::kCable, DriveType::kRigid)));

TEST_P(KernelOf, movesEachLaneAsTheStepInDouble) {
  const std::vector<ChainModel> models = family(robot());
  const testing::DrivenRows rows(models[0], kRows);
  const auto n = static_cast<std::size_t>(models[0].shape.joints);
  int steps = 1;
  for (const ChainModel& model : models)
    steps = std::max(steps, testing::stableSteps(model, rows.start(model)));
  const Moved run = runLanes(set(), models, rows, steps, 1);
  for (const int lane : {0, 5, 15}) {
    const ChainModel& model = models[static_cast<std::size_t>(lane)];
    ChainState<double> state = stateAt(model, rows.start(model), JointVector::Zero(model.shape.joints));
    ChainStep<double> step(model.shape, model.numbers);
    double farthest = 0.0, fastest = 0.0, moved = 0.0;
    for (std::size_t k = 0; k < kRows; ++k) {
      for (std::size_t j = 0; j < n; ++j) {
        farthest = std::max(farthest, std::abs(laneOf(run.q, k, n, j, lane) - state.q[j]));
        fastest = std::max(fastest, std::abs(laneOf(run.dq, k, n, j, lane) - state.dq[j]));
        moved = std::max(moved, std::abs(state.q[j] - laneOf(run.q, 0, n, j, lane)));
      }
      if (k + 1 < kRows) step.advance(rows.at(model.shape, k), steps, state);
    }
    EXPECT_LT(farthest, 1e-9) << "lane " << lane;
    EXPECT_LT(fastest, 1e-7) << "lane " << lane;
    EXPECT_GT(moved, 0.1);
    for (std::size_t j = 0; j < n; ++j) {
      EXPECT_NEAR(run.state.hysteresis[j].value[lane], state.hysteresis[j], 1e-9);
      EXPECT_NEAR(run.state.creep[j].value[lane], state.creep[j], 1e-9);
      EXPECT_NEAR(run.state.motor[j].value[lane], state.motor[j], 1e-6);
    }
  }
}

/// But for the last digit: series are chosen for the lanes of a register together.
TEST_P(KernelOf, lanesKnowNothingOfEachOther) {
  std::vector<ChainModel> models = family(robot());
  const testing::DrivenRows rows(models[0], 101);
  const int steps = 2 * testing::stableSteps(models[15], rows.start(models[15]));
  const Moved before = runLanes(set(), models, rows, steps, 1);
  models[4].numbers.joints[0].coulomb = std::numeric_limits<double>::quiet_NaN();
  models[9].numbers.gravity[0] = 1e6;
  const Moved after = runLanes(set(), models, rows, steps, 1);
  const auto n = static_cast<std::size_t>(models[0].shape.joints);
  bool differ = false;
  for (std::size_t k = 0; k < rows.t.size(); ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (int lane = 0; lane < kChainLanes; ++lane) {
        const double is = laneOf(after.q, k, n, j, lane), was = laneOf(before.q, k, n, j, lane);
        if (lane == 4 || lane == 9)
          differ |= !(is == was);
        else
          ASSERT_NEAR(is, was, 1e-11) << "row " << k << " lane " << lane;
      }
  EXPECT_TRUE(differ);
}

TEST_P(KernelOf, aStretchGoesOnWhereTheLastEnded) {
  const std::vector<ChainModel> models = family(robot());
  const testing::DrivenRows rows(models[0], 201);
  const int steps = 2 * testing::stableSteps(models[15], rows.start(models[15]));
  const Moved whole = runLanes(set(), models, rows, steps, 1),
              sparse = runLanes(set(), models, rows, steps, 7);
  const auto n = static_cast<std::size_t>(models[0].shape.joints);
  for (std::size_t k = 0; 7 * k < rows.t.size(); ++k)
    for (std::size_t j = 0; j < n; ++j)
      ASSERT_EQ(laneOf(sparse.q, k, n, j, 3), laneOf(whole.q, 7 * k, n, j, 3));
  Lanes lanes{};
  for (int lane = 0; lane < kChainLanes; ++lane) {
    const ChainModel& model = models[static_cast<std::size_t>(lane)];
    Lanes::put<ChainNumbers>(model.numbers, lane, lanes.numbers);
    Lanes::put<ChainState>(stateAt(model, rows.start(model), JointVector::Zero(model.shape.joints)), lane,
                           lanes.state);
  }
  std::vector<ChainLane> q(201 * n), dq = q;
  double* const at[] = {q.data()->value, dq.data()->value};
  const auto kernel = simulateChainKernel(set());
  kernel(models[0].shape, lanes.numbers, rows.view(), {0, 101, steps, 1, at[0], at[1]}, lanes.state);
  kernel(models[0].shape, lanes.numbers, rows.view(), {100, 201, steps, 1, at[0], at[1]}, lanes.state);
  for (std::size_t j = 0; j < n; ++j)
    for (int lane = 0; lane < kChainLanes; ++lane)
      EXPECT_EQ(lanes.state.q[j].value[lane], whole.state.q[j].value[lane]);
}

}  // namespace
}  // namespace capstan::robot
