#include "core/robot/chain/chain_state.h"

#include <Eigen/LU>
#include <algorithm>

#include "core/robot/chain/chain_step.h"

namespace capstan::robot {

ChainState<double> stateAt(const ChainModel& model, const JointVector& q, const JointVector& dq) {
  ChainState<double> state{};
  const int n = model.shape.joints;
  for (int i = 0; i < n; ++i) {
    state.q[i] = q[i];
    state.dq[i] = dq[i];
  }
  for (int i = 0; i < n; ++i) {
    if (!(model.shape.laws[i] & kLawCompliance)) continue;
    const JointNumbers<double>& p = model.numbers.joints[i];
    double travel = 0.0, speed = 0.0;
    for (int j = 0; j < n; ++j) {
      travel += model.numbers.coupling[i][j] * (q[j] - model.numbers.joints[j].homing);
      speed += model.numbers.coupling[i][j] * dq[j];
    }
    state.motor[i] = p.link_radius * travel / p.lever;
    state.motor_rate[i] = p.link_radius * speed / p.lever;
  }
  return state;
}

void windUp(const ChainModel& model, const ChainInput& input, ChainState<double>& state) {
  const int n = model.shape.joints;
  ChainShape rigid = model.shape;
  for (int i = 0; i < n; ++i) rigid.laws[i] &= ~static_cast<unsigned>(kLawCompliance);
  if (std::equal(rigid.laws, rigid.laws + n, model.shape.laws)) return;
  ChainStep<double> step(rigid, model.numbers);
  step.look(input, state);
  for (int i = 0; i < n; ++i) {
    if (!(model.shape.laws[i] & kLawCompliance)) continue;
    const JointNumbers<double>& p = model.numbers.joints[i];
    double acceleration = 0.0;  // acceleration of the cable
    for (int j = 0; j < n; ++j)
      acceleration += p.link_radius * model.numbers.coupling[i][j] * step.acceleration()[j];
    const double torque = p.gain * input.torque[i] - motorFriction(p, state.motor_rate[i]).force -
                          p.motor_inertia * acceleration / p.lever;
    state.motor[i] += p.compliance * torque / (p.lever * p.lever);
  }
}

double stretchAt(const ChainModel& model, int i, double q_m, const JointVector& q) {
  const JointNumbers<double>& p = model.numbers.joints[i];
  double travel = 0.0;
  for (int j = 0; j < model.shape.joints; ++j)
    travel += model.numbers.coupling[i][j] * (q[j] - model.numbers.joints[j].homing);
  return motorTravel(p, model.shape.laws[i], q_m) - p.link_radius * travel;
}

JointVector jointsFromMotors(const ChainModel& model, const JointVector& q_m) {
  const int n = model.shape.joints;
  JointVector travel(n), homing(n);
  for (int i = 0; i < n; ++i) {
    const JointNumbers<double>& p = model.numbers.joints[i];
    travel[i] = motorTravel(p, model.shape.laws[i], q_m[i]) / p.link_radius;
    homing[i] = p.homing;
  }
  return homing + couplingMatrix(model).inverse() * travel;
}

}  // namespace capstan::robot
