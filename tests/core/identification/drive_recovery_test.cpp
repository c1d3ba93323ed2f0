#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"
#include "core/identification/drive_identification.h"
#include "tests/core/identification/jaw.h"

namespace capstan::identification {
namespace {

constexpr double kAngleNoise = 2e-3, kTorqueNoise = 2e-3;

/// What the truth differs from the nominal robot by: ln of r_l, k_c, a, b_e, f_c, f_v, tau_c, tau_v.
DriveLogs truthOf(base::Random& random) {
  DriveLogs logs;
  logs << 0.05, 0.4, 1.2, 0.3, 0.3, 0.3, 0.3, 0.3;
  for (int i = 0; i < kDriveQuantities; ++i) logs(i) *= random.normal();
  logs(2) = 1.0 + 0.3 * std::abs(logs(2));  // a cable that visibly stiffens
  return logs;
}

/// A drive without damping, solved another way than the model's: the joint is dragged along by the two
/// positions at which friction is at its limit, which the stretch gives in closed form.
class Play {
 public:
  explicit Play(const DriveLaw<double>& law) : law_(law) {}
  double next(double q_m, double load) {
    const double one = edge(q_m, load - law_.coulomb), other = edge(q_m, load + law_.coulomb);
    q_ = std::clamp(q_, std::min(one, other), std::max(one, other));
    return q_;
  }

 private:
  /// Where 2 k_e sinh(a delta) A r_l = −torque.
  double edge(double q_m, double torque) const {
    const double lever = law_.direction * law_.link_radius;
    const double stretch = std::asinh(-torque / lever * law_.exponent / law_.stiffness) / law_.exponent;
    return (law_.motor_radius * q_m - stretch) / lever;
  }

  DriveLaw<double> law_;
  double q_ = 0.0;
};

DriveRecording motion(double frequency, double load) {
  DriveRecording recording;
  for (double t = 0.0; t < 20.0; t += 0.02) {
    const double w = 2.0 * std::numbers::pi * frequency;
    recording.t.push_back(t);
    recording.q_m.push_back(0.5 - 0.5 * std::cos(w * t) + 0.1 * std::sin(2.3 * w * t));
    recording.dq_m.push_back(0.5 * w * std::sin(w * t) + 0.23 * w * std::cos(2.3 * w * t));
    recording.tau_ext.push_back(-load * (1.0 - 0.2 * std::sin(w * t)));
  }
  return recording;
}

/// Recordings of a drive with these constants and white noise, every file with a zero of its own.
std::vector<DriveRecording> recordings(const DriveParameters& parameters, const DriveLogs& logs,
                                       base::Random& random) {
  std::vector<DriveRecording> all;
  const DriveLaw<double> law = parameters.law<double>(logs.data());
  DrivePrediction<double> truth;
  for (const double frequency : {0.2, 0.7, 1.5})
    for (const double load : {0.01, 0.06, 0.12}) {
      DriveRecording recording = motion(frequency, load);
      predict(law, recording, truth);
      const double zero = 0.02 * random.normal();
      for (std::size_t k = 0; k < recording.size(); ++k) {
        recording.q.push_back(truth.q[k] + zero + kAngleNoise * random.normal());
        recording.tau_m.push_back(truth.tau_m[k] + kTorqueNoise * random.normal());
      }
      all.push_back(recording);
    }
  return all;
}

TEST(DriveModel, WithoutDampingItIsAPlayBehindASpring) {
  const DriveParameters parameters(jaw(), "all");
  DriveLogs logs = DriveLogs::Zero();
  logs(3) = logs(5) = -30.0;
  const DriveLaw<double> law = parameters.law<double>(logs.data());
  for (const double frequency : {0.3, 1.0}) {
    const DriveRecording recording = motion(frequency, 0.08);
    DrivePrediction<double> prediction;
    predict(law, recording, prediction);
    Play play(law);
    double most = 0.0, moved = 0.0;
    for (std::size_t k = 0; k < recording.size(); ++k) {
      const double q = law.homing + play.next(recording.q_m[k], recording.tau_ext[k]);
      if (recording.t[k] < 3.0) continue;  // until both have slid, they know different beginnings
      most = std::max(most, std::abs(q - prediction.q[k]));
      moved = std::max(moved, std::abs(q - law.homing));
    }
    EXPECT_LT(most, 1e-9);
    EXPECT_GT(moved, 0.5);
  }
}

TEST(DriveModel, DerivativesAreThoseOfDifferences) {
  base::Random random(3);
  const DriveParameters parameters(jaw(), "all");
  const auto all = recordings(parameters, truthOf(random), random);
  DriveOptions options;
  options.huber = 1e6;
  DriveFit fit(all, parameters, options);
  DriveFit::Residuals at, up, down;
  DriveLogs logs = DriveLogs::Constant(0.1);
  fit.evaluate(4, logs.data(), 0.01, true, at);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < kDriveQuantities; ++i) {
    DriveLogs moved = logs;
    moved(i) += kStep;
    fit.evaluate(4, moved.data(), 0.01, false, up);
    moved(i) -= 2.0 * kStep;
    fit.evaluate(4, moved.data(), 0.01, false, down);
    const Eigen::VectorXd difference = (up.value - down.value) / (2.0 * kStep);
    // A step may move a row across a reversal, where the derivative jumps: of 1900 rows a few.
    const double scale = at.by_log.col(i).cwiseAbs().maxCoeff();
    const auto off = ((difference - at.by_log.col(i)).array().abs() > 1e-3 * scale).count();
    EXPECT_LT(off, 20) << parameters[i].name();
    EXPECT_GT(scale, 0.0) << parameters[i].name();
  }
}

TEST(DriveRecovery, TruthLiesWithinTheStatedSigmas) {
  constexpr int kWorlds = 6;
  double squares = 0.0;
  int seen = 0, within = 0;
  for (int world = 0; world < kWorlds; ++world) {
    base::Random random(100 + static_cast<std::uint64_t>(world));
    const DriveParameters parameters(jaw(), "all");
    const DriveLogs truth = truthOf(random);
    const DriveReport report = identifyDrive(recordings(parameters, truth, random), parameters);
    EXPECT_EQ(report.end, BatchEnd::kConverged);
    EXPECT_NEAR(report.angle_noise, kAngleNoise, 0.1 * kAngleNoise);
    EXPECT_NEAR(report.torque_noise, kTorqueNoise, 0.1 * kTorqueNoise);
    EXPECT_EQ(report.torque_sign, 1.0);
    for (const DriveEstimate& estimate : report.estimates) {
      const double error = estimate.log - truth(static_cast<int>(estimate.parameter.quantity));
      if (!estimate.seen) continue;
      ++seen;
      squares += std::pow(error / estimate.sigma, 2);
      within += std::abs(error) < 1.96 * estimate.sigma ? 1 : 0;
      if (estimate.parameter.quantity == DriveQuantity::kLinkRadius) {
        EXPECT_LT(std::abs(error), 2e-3);
      } else if (estimate.parameter.quantity == DriveQuantity::kStiffness) {
        EXPECT_LT(std::abs(error), 0.03);
      } else if (estimate.parameter.quantity == DriveQuantity::kCoulomb) {
        EXPECT_LT(std::abs(error), 0.05);
      }
    }
  }
  EXPECT_GE(seen, kWorlds * 6);
  EXPECT_GT(within, 0.85 * seen) << "of " << seen;
  EXPECT_LT(squares / seen, 1.7);
}

TEST(DriveRecovery, OneSharedZeroIsTheRobotsHardStop) {
  base::Random random(8);
  const DriveParameters parameters(jaw(), "all");
  const DriveLogs truth = truthOf(random);
  auto all = recordings(parameters, truth, random);
  DrivePrediction<double> clean;
  for (DriveRecording& recording : all) {
    predict(parameters.law<double>(truth.data()), recording, clean);
    for (std::size_t k = 0; k < recording.size(); ++k)
      recording.q[k] = clean.q[k] + 0.3 + kAngleNoise * random.normal();
  }
  DriveOptions options;
  options.offsets = OffsetRule::kShared;
  const DriveReport report = identifyDrive(all, parameters, options);
  ASSERT_EQ(report.offsets.size(), 1U);
  EXPECT_NEAR(report.offsets.front().value, 0.3, 4.0 * report.offsets.front().sigma);
  EXPECT_LT(report.offsets.front().sigma, 2e-3);
  EXPECT_NEAR(report.robot.joints.front().homing, jaw().joints.front().homing + 0.3, 5e-3);
  const double rms = scoreDrive(report.robot, all, OffsetRule::kShared, DriveOptions::kSkip).rms;
  EXPECT_NEAR(rms, kAngleNoise, 0.05 * kAngleNoise) << "the robot file predicts as the fit did";
}

TEST(DriveRecovery, WhatIsNotSeenStaysNominalAndSaysSo) {
  base::Random random(21);
  const DriveParameters parameters(jaw(), "all");
  auto all = recordings(parameters, truthOf(random), random);
  for (DriveRecording& recording : all)
    for (double& torque : recording.tau_m) torque = std::numeric_limits<double>::quiet_NaN();
  const DriveReport report = identifyDrive(all, parameters);
  EXPECT_EQ(report.torque_noise, 0.0) << "never measured";
  for (const DriveEstimate& estimate : report.estimates) {
    const bool motor = estimate.parameter.quantity == DriveQuantity::kMotorCoulomb ||
                       estimate.parameter.quantity == DriveQuantity::kMotorViscous;
    if (!motor) continue;
    EXPECT_FALSE(estimate.seen);
    EXPECT_EQ(estimate.log, 0.0);
    EXPECT_NE(estimate.advice.find("Record the motor torque"), std::string::npos) << estimate.advice;
  }
  EXPECT_EQ(report.robot.drives.front().motor_friction.coulomb, jaw().drives.front().motor_friction.coulomb);
}

TEST(DriveRecovery, ATorqueCellThatCountsTheOtherWayIsFoundOut) {
  base::Random random(5);
  const DriveParameters parameters(jaw(), "all");
  auto all = recordings(parameters, truthOf(random), random);
  const DriveReport right = identifyDrive(all, parameters);
  for (DriveRecording& recording : all)
    for (double& torque : recording.tau_m) torque = -torque;
  const DriveReport turned = identifyDrive(all, parameters);
  EXPECT_EQ(turned.torque_sign, -1.0);
  for (std::size_t i = 0; i < right.estimates.size(); ++i)
    EXPECT_DOUBLE_EQ(right.estimates[i].log, turned.estimates[i].log);
}

TEST(DriveRecovery, OutliersOfTheEncoderAreHeldBack) {
  base::Random random(31);
  const DriveParameters parameters(jaw(), "all");
  auto all = recordings(parameters, truthOf(random), random);
  const DriveReport clean = identifyDrive(all, parameters);
  for (DriveRecording& recording : all)
    for (std::size_t k = 60; k < recording.size(); k += 50) recording.q[k] += 0.5;
  const DriveReport dirty = identifyDrive(all, parameters);
  EXPECT_GT(dirty.outliers, clean.outliers + 0.005);
  EXPECT_NEAR(dirty.estimates[0].log, clean.estimates[0].log, 2e-3);
  EXPECT_NEAR(dirty.estimates[1].log, clean.estimates[1].log, 0.03);
}

}  // namespace
}  // namespace capstan::identification
