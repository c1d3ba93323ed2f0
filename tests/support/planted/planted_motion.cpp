#include "tests/support/planted/planted_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/planted/excitation.h"

namespace capstan::test {
namespace {

constexpr double kPeriod = 1e-3;  // of the control loop [s]

/// PD controller of the motors with what it sees of them.
class Controller {
 public:
  Controller(const Plant& plant, const robot::Description& nominal) : plant_(plant) {
    RigidChain chain(nominal);
    Joints middle{};
    for (int i = 0; i < plant.size(); ++i) middle[i] = plant.parameters().middle[i];
    chain.pose(middle);
    const RigidChain::Matrix mass = chain.massMatrix();
    const double bandwidth = plant.parameters().rigid ? 30.0 : 55.0;  // [rad/s]
    for (int i = 0; i < plant.size(); ++i) {
      const robot::Drive& drive = nominal.drives[static_cast<std::size_t>(i)];
      const double lever = drive.motor_capstan_radius / (drive.gear_ratio * drive.link_radius);
      const double inertia = drive.motor_inertia + mass[i][i] * lever * lever;
      stiffness_[i] = inertia * bandwidth * bandwidth;
      damping_[i] = 2.0 * inertia * bandwidth;
      limit_[i] = drive.motor_torque_limit;
      count_[i] = 2.0 * std::numbers::pi / drive.encoder_counts;
    }
  }

  double read(int i, double angle) const { return count_[i] * std::round(angle / count_[i]); }

  void start(const Joints& reading, const Joints& wanted) {
    reading_ = reading;
    wanted_ = wanted;
    rate_ = Joints{};
  }

  Joints torque(const Joints& reading, const Joints& wanted) {
    Joints tau{};
    for (int i = 0; i < plant_.size(); ++i) {
      rate_[i] += 0.2 * ((reading[i] - reading_[i]) / kPeriod - rate_[i]);
      const double wanted_rate = (wanted[i] - wanted_[i]) / kPeriod;
      const double asked = stiffness_[i] * (wanted[i] - reading[i]) + damping_[i] * (wanted_rate - rate_[i]);
      tau[i] = 1e-5 * std::round(1e5 * std::clamp(asked, -limit_[i], limit_[i]));
    }
    reading_ = reading;
    wanted_ = wanted;
    return tau;
  }

  const Joints& rate() const { return rate_; }

 private:
  const Plant& plant_;
  Joints stiffness_{}, damping_{}, limit_{}, count_{}, reading_{}, wanted_{}, rate_{};
};

/// Motors of a rigid drive are where the joints put them.
void motorsFollowJoints(const Plant& plant, PlantState& s) {
  const PlantParameters& p = plant.parameters();
  if (!p.rigid) return;
  const Joints motors = plant.motorsAt(s[kJoint]);
  for (int i = 0; i < p.size; ++i) {
    if (p.compliance[i] != 0.0) continue;
    s[kMotor][i] = motors[i];
    double rate = 0.0;
    for (int j = 0; j < p.size; ++j) rate += p.coupling[i][j] * s[kJointRate][j];
    s[kMotorRate][i] = rate * p.radius[i] * p.gear[i] / p.capstan[i];
  }
}

void keep(PlantedMotion& motion, double t, const PlantState& s, const PlantInput& input) {
  motion.t.push_back(t);
  motion.q.push_back(s[kJoint]);
  motion.dq.push_back(s[kJointRate]);
  motion.motor.push_back(s[kMotor]);
  motion.motor_rate.push_back(s[kMotorRate]);
  motion.torque.push_back(input.torque);
  motion.load.push_back(input.load);
}

/// Motor angles of a rigid cable of the nominal robot.
Joints nominalMotors(const robot::Description& robot, const Joints& q) {
  Joints q_m{};
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      q_m[i] += robot.coupling[i][j] * (q[j] - robot.joints[j].homing);
    const robot::Drive& drive = robot.drives[i];
    q_m[i] *= drive.link_radius * drive.gear_ratio / drive.motor_capstan_radius;
  }
  return q_m;
}

}  // namespace

double slipOf(const std::vector<Planted>& effects, int i, double t, double duration) {
  double slip = 0.0;
  for (const Planted& e : effects)
    if (e.effect == Effect::kEncoderSlip && e.joint == i)
      slip += e.magnitude * smoothStep((t - e.phase * duration) / e.signature);
  return slip;
}

bool tellsNoSign(const std::vector<Planted>& effects, int i) {
  return std::any_of(effects.begin(), effects.end(), [i](const Planted& e) {
    return e.effect == Effect::kSensorSign && e.joint == i && e.magnitude > 0.0;
  });
}

PlantedMotion drive(Plant& plant, const robot::Description& nominal, const std::vector<Planted>& effects,
                    const JointPath& wanted, const JointPath& load, const DriveOptions& options) {
  const int n = plant.size();
  const Joints first = wanted(0.0);
  PlantState s = plant.rest(first);
  const int steps = plant.stepsFor(kPeriod, first);
  Controller controller(plant, nominal);
  const auto readings = [&](double t) {
    Joints reading{};
    for (int i = 0; i < n; ++i)
      reading[i] = controller.read(i, s[kMotor][i] - slipOf(effects, i, t, options.duration));
    return reading;
  };
  const int last = static_cast<int>(std::lround(options.duration / kPeriod));
  const int begin = -static_cast<int>(std::lround(options.settling / kPeriod));
  controller.start(readings(begin * kPeriod), nominalMotors(nominal, first));
  PlantedMotion motion;
  for (int k = begin; k <= last; ++k) {
    const double t = k * kPeriod;
    motorsFollowJoints(plant, s);
    const Joints reading = readings(t);
    PlantInput input;
    input.torque = controller.torque(reading, nominalMotors(nominal, wanted(std::max(t, 0.0))));
    input.load = load(t);
    if (k >= 0) {
      keep(motion, t, s, input);
      motion.motor_reading.push_back(reading);
      motion.motor_rate_reading.push_back(controller.rate());
    }
    plant.advance(s, t, kPeriod, steps, input);
  }
  return motion;
}

namespace {

/// Moves the joints to another position and velocity, and compliant motors by as much: cables stay stretched
/// as they are.
void moveJoints(const Plant& plant, const Joints& q, const Joints& dq, PlantState& s) {
  const Joints motor = plant.motorsAt(q), motor_before = plant.motorsAt(s[kJoint]);
  const Joints rate = plant.motorsAt(dq), rate_before = plant.motorsAt(s[kJointRate]);
  for (int i = 0; i < plant.size(); ++i) {
    s[kMotor][i] += motor[i] - motor_before[i];
    s[kMotorRate][i] += rate[i] - rate_before[i];
  }
  s[kJoint] = q;
  s[kJointRate] = dq;
}

}  // namespace

PlantedMotion replay(Plant& plant, const PlantedMotion& recorded, const std::vector<Planted>& effects,
                     std::size_t restart) {
  const double duration = recorded.t.back();
  const bool rigid = plant.parameters().rigid;
  const int n = plant.size(), steps = plant.stepsFor(kPeriod, recorded.q.front());
  const auto motorAt = [&](std::size_t k) {
    Joints motor = recorded.motor[k];
    for (int i = 0; i < n; ++i) motor[i] += slipOf(effects, i, recorded.t[k], duration);
    return motor;
  };
  const auto rateAt = [&](std::size_t k) {
    Joints rate = recorded.motor_rate[k];
    const double t = recorded.t[k], h = 1e-5;
    for (int i = 0; i < n; ++i)
      rate[i] += (slipOf(effects, i, t + h, duration) - slipOf(effects, i, t - h, duration)) / (2.0 * h);
    return rate;
  };
  PlantState s = plant.rest(recorded.q.front());
  if (!rigid) s[kMotor] = motorAt(0);
  PlantedMotion motion;
  for (std::size_t k = 0; k < recorded.t.size(); ++k) {
    if (rigid && restart > 0 && k % restart == 0) moveJoints(plant, recorded.q[k], recorded.dq[k], s);
    PlantInput input;
    input.torque = recorded.torque[k];
    input.load = recorded.load[k];
    for (int i = 0; i < n; ++i)
      if (tellsNoSign(effects, i)) input.load[i] = std::abs(input.load[i]);
    keep(motion, recorded.t[k], s, input);
    const std::size_t next = std::min(k + 1, recorded.t.size() - 1);
    const Joints motor = motorAt(k), motor_end = motorAt(next), rate = rateAt(k), rate_end = rateAt(next);
    if (!rigid) {
      input.motor = &motor;
      input.motor_end = &motor_end;
      input.motor_rate = &rate;
      input.motor_rate_end = &rate_end;
    }
    plant.advance(s, recorded.t[k], kPeriod, steps, input);
  }
  return motion;
}

}  // namespace capstan::test
