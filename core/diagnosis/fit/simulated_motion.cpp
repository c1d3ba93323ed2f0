#include <algorithm>

#include "core/diagnosis/fit/chain_simulation.h"
#include "core/robot/chain/chain_state.h"
#include "core/robot/chain/chain_step.h"

namespace capstan::diagnosis {

SimulatedMotion ChainSimulation::motion(const robot::ChainModel& model) const {
  const auto n = static_cast<std::size_t>(joints_);
  SimulatedMotion motion;
  for (Columns* columns : {&motion.q, &motion.dq, &motion.ddq, &motion.tau, &motion.stretch})
    columns->assign(n, std::vector<double>(evidence_.rows(), 0.0));
  const int steps = stepsFor(model);
  robot::ChainStep<double> step(model.shape, model.numbers);
  std::size_t w = 0;
  for (const Segment& segment : evidence_.segments) {
    while (w + 1 < windows_.size() && windows_[w].begin < segment.begin) ++w;
    robot::ChainState<double> state = initialState(model, nullptr, w);
    const std::size_t started =
        segment.begin + startingOutputs({segment.begin, segment.end}) * static_cast<std::size_t>(stride_);
    for (std::size_t k = segment.begin; k < segment.end; ++k) {
      const std::size_t next = std::min(k + 1, segment.end - 1);
      const robot::ChainInput input = inputAt(k, next);
      step.look(input, state);
      for (std::size_t j = 0; j < n; ++j) {
        motion.q[j][k] = state.q[j];
        motion.dq[j][k] = state.dq[j];
        motion.ddq[j][k] = step.acceleration()[j];
        motion.tau[j][k] = step.torque()[j];
        motion.stretch[j][k] = step.stretch()[j];
      }
      if (next > k) step.advance(input, k < started ? std::max(steps, startingSteps()) : steps, state);
    }
  }
  if (evidence_.hasCameras()) {
    for (const TipObservation& observation : evidence_.tip) {
      const double row = std::max(observation.row - model.camera.delay / evidence_.step, 0.0);
      robot::JointVector q(joints_);
      for (int j = 0; j < joints_; ++j) q[j] = Evidence::at(motion.q[static_cast<std::size_t>(j)], row);
      motion.tip.push_back(model.camera.measure(chain_.marker(q)));
    }
  }
  return motion;
}

}  // namespace capstan::diagnosis
