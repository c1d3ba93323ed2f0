#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/estimation/square_root_ukf.h"
#include "core/robot/arm_kernel.h"
#include "core/robot/description.h"
#include "core/tracking/cable_arm_model.h"
#include "tests/support/folders.h"

/// What the candidate models of ukf_benchmark.cpp are given, and the scalar model that the slower ones run.
namespace capstan::bench {

using tracking::CableArmModel;
using tracking::MotorState;
using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Filter = estimation::SquareRootUkf<6>;
using Joints = estimation::LinearMeasurement<6, 3>;

/// Sample period of the robot; with a single RK4 step a sample is a quarter as long, for stability.
inline constexpr double kPeriod = 1e-3;
inline constexpr int kSamples = 2000;

/// One second of motor motion and noisy joint observations; every candidate model gets the same.
struct Problem {
  robot::Description robot = robot::readDescription(test::resourceFile("robots/raven2_left.yaml"));
  std::vector<MotorState> motor;
  std::vector<Vector3> y;
  Vector6 mean0;
  Vector6 sigma0, sigma_q;
  Vector3 sigma_r{2e-3, 2e-3, 5e-4};
  Joints joints;
  double dt;

  explicit Problem(double period) : dt(period) {
    mean0 << 0.8, 0.0, 1.6, 0.0, 0.4, 0.0;
    sigma0 << 0.02, 0.1, 0.02, 0.1, 0.002, 0.02;
    sigma_q << 1e-5, 1e-2, 1e-5, 1e-2, 1e-6, 1e-3;
    const auto c = tracking::cableArmConstants(robot);
    for (int i = 0; i < 3; ++i) joints.h(i, 2 * i) = 1.0;
    const Vector3 centre(mean0(0), mean0(2), mean0(4)), swing(0.2, 0.15, 0.03);
    for (int k = 0; k <= kSamples; ++k) {
      MotorState sample;
      Vector3 q, dq;
      for (int i = 0; i < 3; ++i) {
        const double w = 2.0 + i, t = k * dt;
        q(i) = centre(i) + swing(i) * (1.0 - std::cos(w * t));
        dq(i) = swing(i) * w * std::sin(w * t);
      }
      for (int i = 0; i < 3; ++i) {
        double travel = 0.0, speed = 0.0;
        for (int j = 0; j < 3; ++j) {
          travel += c.coupling[i][j] * (q(j) - c.homing[j]);
          speed += c.coupling[i][j] * dq(j);
        }
        sample.position(i) = c.link_radius[i] * travel / c.motor_scale[i];
        sample.velocity(i) = c.link_radius[i] * speed / c.motor_scale[i];
      }
      motor.push_back(sample);
      y.push_back(q +
                  sigma_r.cwiseProduct(Vector3(std::sin(12.9 * k), std::sin(78.2 * k), std::sin(37.7 * k))));
    }
  }
};

inline const Problem& problemFor(int steps) {
  static const Problem whole(kPeriod), quarter(kPeriod / 4.0);
  return steps == 1 ? quarter : whole;
}

/// The model one point at a time, in closed form with the C library's functions.
class ScalarArm {
 public:
  explicit ScalarArm(int steps)
      : c_(tracking::cableArmConstants(problemFor(steps).robot)), dt_(problemFor(steps).dt), steps_(steps) {}

  void propagate(double* x, const tracking::CableArmDrive& drive) const {
    const double h = dt_ / steps_;
    for (int s = 0; s < steps_; ++s) {
      std::array<double, 6> k1, k2, k3, k4, stage;
      slope(x, drive, double(s) / steps_, k1.data());
      for (std::size_t i = 0; i < 6; ++i) stage[i] = x[i] + 0.5 * h * k1[i];
      slope(stage.data(), drive, (s + 0.5) / steps_, k2.data());
      for (std::size_t i = 0; i < 6; ++i) stage[i] = x[i] + 0.5 * h * k2[i];
      slope(stage.data(), drive, (s + 0.5) / steps_, k3.data());
      for (std::size_t i = 0; i < 6; ++i) stage[i] = x[i] + h * k3[i];
      slope(stage.data(), drive, (s + 1.0) / steps_, k4.data());
      for (std::size_t i = 0; i < 6; ++i) x[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
    }
  }

 private:
  void slope(const double* x, const tracking::CableArmDrive& d, double at, double* dx) const {
    std::array<double, 3> tension, tau;
    const std::array<double, 3> dq = {x[1], x[3], x[5]};
    const std::array<double, 3> out = {x[0] - c_.homing[0], x[2] - c_.homing[1], x[4] - c_.homing[2]};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& row = c_.coupling[i];
      const double s = d.position0[i] + at * (d.position1[i] - d.position0[i]);
      const double v = d.velocity0[i] + at * (d.velocity1[i] - d.velocity0[i]);
      const double delta =
          c_.motor_scale[i] * s - c_.link_radius[i] * (row[0] * out[0] + row[1] * out[1] + row[2] * out[2]);
      const double rate =
          c_.motor_scale[i] * v - c_.link_radius[i] * (row[0] * dq[0] + row[1] * dq[1] + row[2] * dq[2]);
      tension[i] = c_.link_radius[i] *
                   (2.0 * c_.stiffness[i] * std::sinh(c_.exponent[i] * delta) + 2.0 * c_.damping[i] * rate);
    }
    for (std::size_t j = 0; j < 3; ++j)
      tau[j] = c_.coupling[0][j] * tension[0] + c_.coupling[1][j] * tension[1] +
               c_.coupling[2][j] * tension[2] - c_.coulomb[j] * std::tanh(dq[j] * c_.inverse_smoothing[j]) -
               c_.viscous[j] * dq[j];
    const auto ddq = robot::armForward<double>(
        c_.body, {std::sin(x[0]), std::cos(x[0]), std::sin(x[2]), std::cos(x[2])}, x[4], dq, tau);
    for (std::size_t i = 0; i < 3; ++i) {
      dx[2 * i] = dq[i];
      dx[2 * i + 1] = ddq[i];
    }
  }

  tracking::CableArmConstants c_;
  double dt_;
  int steps_;
};

}  // namespace capstan::bench
