#include "tests/support/measured_diagnosis/emps.h"

#include <cmath>

#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/horizons.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/chain/chain_state.h"
#include "core/robot/chain/chain_step.h"
#include "tests/support/measured_diagnosis/steps.h"
#include "tests/support/measured_diagnosis/whole_fit.h"

namespace capstan::measured {
namespace {

double errorFrom(double position, double speed, const robot::ChainModel& model,
                 const diagnosis::Evidence& e) {
  constexpr int kSubsteps = 4;
  robot::ChainStep<double> step(model.shape, model.numbers);
  robot::ChainState<double> state = robot::stateAt(model, robot::JointVector::Constant(1, position),
                                                   robot::JointVector::Constant(1, speed));
  double squares = 0.0;
  for (std::size_t k = 0; k < e.rows(); ++k) {
    squares += std::pow(e.q[0][k] - state.q[0], 2);
    robot::ChainInput input;
    input.t = e.t[k], input.dt = e.step;
    input.torque[0] = e.tau_m[0][k];
    step.advance(input, kSubsteps, state);
  }
  return 1e3 * std::sqrt(squares / static_cast<double>(e.rows()));
}

diagnosis::FitModel withOffset(const diagnosis::FitModel& model) {
  const diagnosis::Hypothesis& offset = *diagnosis::hypothesisNamed("torque_offset");
  return model.with(offset, 1, offset.starts(model.scales().front(), 1).front());
}

}  // namespace

EmpsErrors openLoopErrors(const robot::Description& robot, const std::filesystem::path& record) {
  const diagnosis::Evidence e = diagnosis::readEvidence(record, robot);
  const robot::ChainModel model(robot);
  const diagnosis::ChainSimulation whole(e, robot, 0.0);
  const Eigen::MatrixXd& start = whole.initialStates();
  return {errorFrom(e.q[0].front(), 0.0, model, e), errorFrom(start(0, 0), start(1, 0), model, e)};
}

std::vector<EmpsStep> empsSteps(const std::filesystem::path& folder, EmpsStart start, int threads) {
  using diagnosis::EncoderZeros;
  const robot::Description nominal = robotFile("emps_axis.yaml");
  const std::vector<diagnosis::Evidence> train{diagnosis::readEvidence(folder / "train.csv", nominal)};
  diagnosis::FitModel base(nominal, diagnosis::jointScales(train, nominal));
  if (start == EmpsStart::kFourNumbers) base = withOffset(base);
  std::vector<EmpsStep> steps;
  const auto [data, selection] =
      diagnosis::selectOverHorizons(train, nominal, base, EncoderZeros::kKnown, threads, {}, nullptr);
  for (const Step& step : stepsOf(*data, selection)) {
    const diagnosis::Fit whole = wholeFit(train, nominal, step.fit, EncoderZeros::kKnown, threads);
    EmpsStep one{.name = step.name,
                 .competitors = step.competitors,
                 .robot = step.fit.model.extended(step.fit.u),
                 .train = {},
                 .test = {},
                 .whole = whole.model.extended(whole.u),
                 .whole_train = {},
                 .whole_test = {}};
    one.train = openLoopErrors(one.robot, folder / "train.csv");
    one.test = openLoopErrors(one.robot, folder / "test.csv");
    one.whole_train = openLoopErrors(one.whole, folder / "train.csv");
    one.whole_test = openLoopErrors(one.whole, folder / "test.csv");
    steps.push_back(std::move(one));
  }
  return steps;
}

}  // namespace capstan::measured
