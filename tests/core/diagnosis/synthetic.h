/// Recordings whose residual is known, made of sines.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/robot/description.h"
#include "core/robot/transmission.h"

namespace capstan::diagnosis {

struct Scene {
  robot::Description robot;
  Evidence evidence;
  SimulatedMotion simulated;
};

/// `joints` turning joints, each with a motor behind a gear of sixty.
inline robot::Description turningRobot(int joints) {
  robot::Description robot;
  robot.name = "turning";
  for (int j = 0; j < joints; ++j) {
    robot.joints.emplace_back();
    robot.drives.emplace_back();
    robot.drives.back().gear_ratio = 60.0;
    robot.drives.back().motor_capstan_radius = 0.01;
    robot.drives.back().link_radius = 0.03;
    robot.coupling.emplace_back(static_cast<std::size_t>(joints), 0.0);
    robot.coupling[static_cast<std::size_t>(j)][static_cast<std::size_t>(j)] = 1.0;
  }
  return robot;
}

/// Sum of five sines of 0.1 … 0.9 Hz with phases and frequencies from `random`, amplitudes that sum to 1.
inline std::function<double(double)> multisine(base::Random& random) {
  std::vector<std::array<double, 3>> terms;
  for (int k = 0; k < 5; ++k)
    terms.push_back({0.2, random.uniform(0.1 + 0.16 * k, 0.26 + 0.16 * k), random.uniform(0.0, 6.28)});
  return [terms](double t) {
    double sum = 0.0;
    for (const auto& [a, f, phase] : terms) sum += a * std::sin(2.0 * std::numbers::pi * f * t + phase);
    return sum;
  };
}

/// A recording that agrees with its simulation to the last bit: tests add what it gets wrong.
inline Scene scene(int joints, double seconds, std::uint64_t seed, double step = 1e-3) {
  Scene s;
  s.robot = turningRobot(joints);
  base::Random random(seed, "scene");
  const auto rows = static_cast<std::size_t>(std::lround(seconds / step)) + 1;
  s.evidence.title = "scene";
  s.evidence.joints = joints;
  s.evidence.step = step;
  s.evidence.segments = {{0, rows}};
  s.evidence.exclusions.assign(rows, 0);
  for (std::size_t i = 0; i < rows; ++i) s.evidence.t.push_back(step * static_cast<double>(i));
  const robot::Transmission transmission(s.robot);
  for (int j = 0; j < joints; ++j) {
    const auto motion = multisine(random), load = multisine(random);
    std::vector<double> q, tau;
    for (const double t : s.evidence.t) q.push_back(0.8 * motion(t)), tau.push_back(2.0 * load(t));
    std::vector<double> q_m(q);
    const double ratio = transmission.linkRadius()(j) / transmission.motorRadius()(j);
    for (double& x : q_m) x *= ratio;
    s.simulated.q.push_back(q);
    s.simulated.tau.push_back(tau);
    s.evidence.q.push_back(q);
    s.evidence.tau_m.push_back(tau);
    s.evidence.q_m.push_back(q_m);
    s.evidence.dq_m.emplace_back(rows, 0.0);
    s.evidence.noise.q.push_back({0.0, 1e-4});
  }
  return s;
}

/// Noise that forgets itself within `memory` seconds (first order), of standard deviation `sigma`.
inline std::vector<double> slowNoise(base::Random& random, std::size_t rows, double step, double memory,
                                     double sigma) {
  const double keep = std::exp(-step / memory);
  std::vector<double> noise;
  double x = random.normal(0.0, sigma);
  for (std::size_t i = 0; i < rows; ++i) {
    noise.push_back(x);
    x = keep * x + random.normal(0.0, sigma * std::sqrt(1.0 - keep * keep));
  }
  return noise;
}

}  // namespace capstan::diagnosis
