#include "tests/support/measured_diagnosis/emps.h"

#include <cmath>

#include "core/diagnosis/joint_scales.h"
#include "core/diagnosis/read_evidence.h"
#include "core/diagnosis/whole_fit.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/chain/chain_step.h"
#include "tests/support/measured_diagnosis/steps.h"

namespace capstan::measured {

double openLoopError(const robot::Description& robot, const std::filesystem::path& record) {
  constexpr int kSubsteps = 4;
  const diagnosis::Evidence e = diagnosis::readEvidence(record, robot);
  const robot::ChainModel model(robot);
  robot::ChainStep<double> step(model.shape, model.numbers);
  robot::ChainState<double> state =
      robot::stateAt(model, robot::JointVector::Constant(1, e.q[0].front()), robot::JointVector::Zero(1));
  double squares = 0.0;
  for (std::size_t k = 0; k < e.rows(); ++k) {
    squares += std::pow(e.q[0][k] - state.q[0], 2);
    robot::ChainInput input;
    input.t = e.t[k], input.dt = e.step;
    input.torque[0] = e.tau_m[0][k];
    step.advance(input, kSubsteps, state);
  }
  return std::sqrt(squares / static_cast<double>(e.rows()));
}

std::vector<EmpsStep> empsSteps(const std::filesystem::path& folder, int threads) {
  constexpr double kHorizon = 0.0;  // the benchmark asks for whole records
  const robot::Description nominal = robotFile("emps_axis.yaml");
  const std::vector<diagnosis::Evidence> train{diagnosis::readEvidence(folder / "train.csv", nominal)};
  const diagnosis::FitData data(train, nominal, kHorizon, false, threads);
  const diagnosis::FitModel base(nominal, diagnosis::jointScales(train, nominal));
  std::vector<EmpsStep> steps;
  for (const Step& step : stepsOf(diagnosis::select(data, train, base, {}, nullptr))) {
    const diagnosis::Fit whole = diagnosis::wholeFit(train, nominal, step.fit, false, threads);
    EmpsStep one{step.name, whole.model.extended(whole.u), 0.0, 0.0};
    one.train_mm = 1e3 * openLoopError(one.robot, folder / "train.csv");
    one.test_mm = 1e3 * openLoopError(one.robot, folder / "test.csv");
    steps.push_back(std::move(one));
  }
  return steps;
}

}  // namespace capstan::measured
