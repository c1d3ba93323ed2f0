#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "widgets/figures/boxplot_figure.h"
#include "widgets/figures/convergence_figure.h"
#include "widgets/figures/histogram_figure.h"
#include "widgets/figures/trajectory_figure.h"

/// Made-up data of the size and shape that experiments bring.
namespace capstan::widgets {

inline const char* const kTestJoints[] = {"shoulder q1", "elbow q2", "insertion q3"};
inline const char* const kTestUnits[] = {"deg", "deg", "mm"};

/// Student's t noise of three degrees of freedom about `mean`.
inline std::vector<double> noise(std::size_t n, double mean, double scale, unsigned seed) {
  std::mt19937_64 random(seed);
  std::student_t_distribution<double> draw(3.0);
  std::vector<double> values(n);
  for (double& value : values) value = mean + scale * draw(random);
  return values;
}

inline HistogramData histogramSample() {
  HistogramData data{.title = "Experiment C, trial 1: errors of the joint positions",
                     .note = "UKF and transmission kinematics against the joint encoders, 188 s"};
  for (unsigned joint = 0; joint < 3; ++joint)
    data.panels.push_back({kTestJoints[joint],
                           kTestUnits[joint],
                           {{{Quantity::kKinematic}, noise(18'800, 1.2, 0.25, joint)},
                            {{Quantity::kUkf}, noise(18'800, 0.1, 0.2, 10 + joint)}}});
  return data;
}

inline BoxplotData boxplotSample(std::size_t trials = 6) {
  BoxplotData data{.title = "Experiment C: errors of joint 1 in six trials"};
  BoxplotPanel panel{.title = kTestJoints[0], .unit = "deg", .x_label = "trial"};
  for (unsigned trial = 0; trial < trials; ++trial)
    panel.groups.push_back(
        {QString::number(trial + 1),
         {{{Quantity::kKinematic}, boxplotOf(noise(18'800, 1.0 + 0.1 * trial, 0.3, trial))},
          {{Quantity::kUkf}, boxplotOf(noise(18'800, 0.1, 0.2, 20 + trial))}}});
  data.panels.push_back(panel);
  return data;
}

inline BoxplotData occlusionSample() {
  BoxplotData data{.title = "Experiment D: |error| of the UKF by occlusion", .quantity = "|error|"};
  for (unsigned joint = 0; joint < 3; ++joint) {
    BoxplotPanel panel{.title = kTestJoints[joint], .unit = kTestUnits[joint], .x_label = "occlusion [%]"};
    for (const unsigned share : {10U, 20U, 40U, 60U, 80U}) {
      std::vector<double> values = noise(20'000, 0.0, 0.3 + 0.001 * share, share + joint);
      for (double& value : values) value = std::abs(value);
      panel.groups.push_back({QString::number(share), {{{Quantity::kUkf}, boxplotOf(values)}}});
    }
    data.panels.push_back(panel);
  }
  return data;
}

inline ConvergencePanel convergenceSample(const char* title, const char* unit, double nominal, double truth,
                                          double settled, unsigned seed) {
  ConvergencePanel panel{.title = title, .unit = unit, .nominal = nominal, .truth = truth};
  if (settled > 0.0) panel.settled_at = settled;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> draw(0.0, 0.002);
  for (double t = 0.0; t <= 200.0; t += 0.5) {
    const double left = std::exp(-t / 15.0);
    panel.t.push_back(t);
    panel.value.push_back(truth + (nominal - truth) * left + nominal * draw(random) * std::exp(-t / 60.0));
    panel.sigma.push_back(nominal * (0.1 * left + 0.001));
  }
  return panel;
}

inline ConvergenceData radiusSample() {
  return {.title = "Experiment A: radius of joint 1's pulley",
          .note = "dual UKF, 200 s sinusoid",
          .panels = {convergenceSample("radius r_l, joint 1", "mm", 63.095, 59.0, 41.0, 1)},
          .occluded = {{30.0, 50.0}, {110.0, 115.0}}};
}

inline ConvergenceData cableSample() {
  ConvergenceData data{.title = "Experiment B: cable parameters", .note = "dual UKF, 200 s block transfer"};
  for (double t = 18.0; t < 200.0; t += 20.0) data.occluded.emplace_back(t, t + 2.0);
  for (unsigned joint = 1; joint <= 3; ++joint) {
    const std::string name = "joint " + std::to_string(joint);
    data.panels.push_back(convergenceSample(("stiffness k_e, " + name).c_str(), "kN/m", 720.0,
                                            600.0 + 30.0 * joint, 80.0, joint));
    data.panels.push_back(convergenceSample(("damping b_e, " + name).c_str(), "N s/m", 95.0, 80.0,
                                            joint == 3 ? 0.0 : 120.0, 9 + joint));
    for (std::size_t i = data.panels.size() - 2; i < data.panels.size(); ++i)
      data.panels[i].group = static_cast<int>(joint);
  }
  return data;
}

/// 20 samples a second of three sinusoids; camera 15 times a second, lost for two of ten seconds.
inline TrajectoryData trajectorySample(double duration = 200.0) {
  TrajectoryData data{.title = "Experiment C, trial 1: joint positions",
                      .note = "FLS block transfer, 10 % occluded"};
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::nan(""));
  for (int i = 0; i <= static_cast<int>(20.0 * duration); ++i) {
    const double t = 0.05 * i;
    TrajectorySample s;
    s.t = t;
    s.q_true = {0.8 + 0.3 * std::sin(0.5 * t), 1.5 + 0.25 * std::sin(0.7 * t + 1.0),
                0.40 + 0.05 * std::sin(0.6 * t + 2.0)};
    s.q_kin = s.q_true + Eigen::Vector3d(0.03, -0.04, 0.003);
    s.q_ukf = s.q_true + Eigen::Vector3d(0.004, 0.005, 0.0004) * std::sin(7.0 * t);
    s.sigma = {0.006, 0.006, 0.0006};
    s.occluded = std::fmod(t, 20.0) >= 18.0;
    s.q_cam = s.occluded
                  ? none
                  : Eigen::Vector3d(s.q_true + Eigen::Vector3d(0.012, 0.009, 0.002) * std::sin(90.0 * t));
    data.samples.push_back(s);
  }
  return data;
}

}  // namespace capstan::widgets
