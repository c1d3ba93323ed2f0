#include "core/identification/identification_data.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/estimation/occlusion_gate.h"
#include "core/stats/chi_square.h"
#include "core/stats/quantile.h"
#include "core/tracking/encoder_watch.h"

namespace capstan::identification {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kFewestTriples = 30;
constexpr double kSecondDifference = 6.0;  // variance of n₁ − 2 n₂ + n₃ / variance of n

/// Second difference of tip − tip_kin, and index of the middle observation.
struct Triple {
  Vector3d difference;
  std::size_t middle;
};

std::vector<Triple> triplesOf(const std::vector<CameraObservation>& seen) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < seen.size(); ++i) periods.push_back(seen[i].t - seen[i - 1].t);
  const double longest = 1.5 * stats::median(periods);
  std::vector<Triple> triples;
  for (std::size_t i = 2; i < seen.size(); ++i) {
    const CameraObservation &a = seen[i - 2], &b = seen[i - 1], &c = seen[i];
    if (!a.open || !b.open || !c.open || b.t - a.t > longest || c.t - b.t > longest) continue;
    const Vector3d difference = (a.tip - a.tip_kin) - 2.0 * (b.tip - b.tip_kin) + (c.tip - c.tip_kin);
    if (difference.allFinite()) triples.push_back({difference, i - 1});
  }
  return triples;
}

/// Covariance of the noise: mean of squares, computed again without the outliers of the previous mean.
Matrix3d measuredCovariance(const std::vector<Triple>& triples) {
  const double limit = stats::chiSquareQuantile(3, 0.999);
  Matrix3d covariance = Matrix3d::Zero();
  for (int pass = 0; pass < 3; ++pass) {
    const Matrix3d before = covariance;
    const Eigen::LLT<Matrix3d> root(before);
    covariance.setZero();
    double count = 0.0;
    for (const Triple& triple : triples) {
      if (pass > 0 && root.matrixL().solve(triple.difference).squaredNorm() > limit) continue;
      covariance += triple.difference * triple.difference.transpose();
      count += 1.0;
    }
    covariance /= count;
  }
  return covariance / kSecondDifference;
}

double measuredRatio(const std::vector<Triple>& triples, const std::vector<CameraObservation>& seen) {
  std::vector<double> squares;
  squares.reserve(triples.size());
  for (const Triple& triple : triples)
    squares.push_back(
        triple.difference.dot(seen[triple.middle].tip_covariance.llt().solve(triple.difference)) /
        kSecondDifference);
  return std::sqrt(stats::median(squares) / stats::chiSquareQuantile(3, 0.5));
}

}  // namespace

std::size_t MotorTrack::at(double time) const {
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  return after == t.begin() ? 0 : static_cast<std::size_t>(after - t.begin()) - 1;
}

std::size_t IdentificationData::openCount() const {
  return static_cast<std::size_t>(
      std::count_if(cameras.begin(), cameras.end(), [](const CameraObservation& seen) { return seen.open; }));
}

void measureNoise(IdentificationData& data) {
  const std::vector<Triple> triples = triplesOf(data.cameras);
  if (triples.size() < kFewestTriples) return;
  data.noise_ratio = measuredRatio(triples, data.cameras);
  if (!(data.noise_ratio > 0.0) || !std::isfinite(data.noise_ratio)) {
    data.noise_ratio = 1.0;
    return;
  }
  const robot::ArmKinematics arm(data.robot);
  const Matrix3d measured = measuredCovariance(triples);
  for (CameraObservation& seen : data.cameras) {
    seen.tip_covariance =
        data.images ? Matrix3d(data.noise_ratio * data.noise_ratio * seen.tip_covariance) : measured;
    if (!seen.open) continue;
    const Matrix3d inverse = arm.tipJacobian(seen.q_cam).inverse();
    seen.q_covariance = inverse * seen.tip_covariance * inverse.transpose();
  }
}

void append(IdentificationData& data, const IdentificationData& more) {
  if (more.motors.t.empty()) return;
  const double shift = data.motors.t.empty() ? 0.0 : data.motors.t.back() + 1.0 - more.motors.t.front();
  data.excluded += more.excluded;
  for (const double t : more.motors.t) data.motors.t.push_back(t + shift);
  data.motors.position.insert(data.motors.position.end(), more.motors.position.begin(),
                              more.motors.position.end());
  data.motors.velocity.insert(data.motors.velocity.end(), more.motors.velocity.begin(),
                              more.motors.velocity.end());
  for (CameraObservation seen : more.cameras) {
    seen.t += shift;
    data.cameras.push_back(seen);
  }
}

DataCollector::DataCollector(const tracking::TrackingPipeline& pipeline, std::string title)
    : arm_(pipeline.robot()),
      base_from_camera_(pipeline.registration()),
      tip_sigma_(pipeline.options().tip_sigma),
      jump_tolerance_(pipeline.options().jump_tolerance) {
  data_.title = std::move(title);
  data_.robot = pipeline.robot();
}

void DataCollector::addMotors(const tracking::Snapshot& snapshot) {
  MotorTrack& motors = data_.motors;
  excludeFrozen(snapshot);
  if (!motorsKnown(snapshot)) {
    ++data_.excluded;
    return;
  }
  motors.t.push_back(snapshot.t);
  motors.position.push_back(snapshot.q_motor);
  motors.velocity.push_back(snapshot.dq_motor);
}

void DataCollector::excludeFrozen(const tracking::Snapshot& snapshot) {
  MotorTrack& motors = data_.motors;
  for (std::size_t i = 0; i < 3; ++i) {
    if (snapshot.motor_failed[i] == failed_[i]) continue;
    failed_[i] = snapshot.motor_failed[i];
    if (failed_[i] != tracking::MotorFault::kFrozen) continue;
    const auto motor = static_cast<Eigen::Index>(i);
    const double still = tracking::stillWithin(data_.robot.drives[i]);
    while (!motors.t.empty() && std::abs(motors.position.back()(motor) - snapshot.q_motor(motor)) <= still) {
      motors.t.pop_back();
      motors.position.pop_back();
      motors.velocity.pop_back();
      ++data_.excluded;
    }
  }
}

void DataCollector::add(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
  if (std::holds_alternative<tracking::MotorSample>(sample)) {
    if (snapshot.motor_samples != taken_) addMotors(snapshot);  // else the pipeline refused it
    taken_ = snapshot.motor_samples;
    return;
  }
  if (!snapshot.camera_updated || !snapshot.tip_cam.allFinite() || !snapshot.q_link_cam.allFinite()) return;
  if (tracking::anyMotorFailed(snapshot)) return;
  CameraObservation seen;
  seen.t = snapshot.t_cam;
  seen.tip = snapshot.tip_cam;
  seen.tip_kin = snapshot.tip_kin_cam;
  seen.q_cam = snapshot.q_link_cam;
  // The χ² gate assumes the nominal parameters. Where they are wrong, it would reject the errors of one side
  // only.
  const bool near =
      ((seen.q_cam - arm_.solvePosition(seen.tip_kin, seen.q_cam).value_or(seen.q_cam)).cwiseAbs().array() <
       jump_tolerance_.array())
          .all();
  seen.open = snapshot.gate == tracking::Gate::kOpen || (snapshot.gate == tracking::Gate::kJump && near);
  if (snapshot.camera_images && base_from_camera_) {
    const Matrix3d turn = base_from_camera_->linear();
    seen.tip_covariance = turn * snapshot.tip_in_camera_covariance * turn.transpose();
    data_.images = true;
  } else {
    seen.tip_covariance = tip_sigma_.cwiseAbs2().asDiagonal();
  }
  const Matrix3d inverse = arm_.tipJacobian(seen.q_cam).inverse();
  seen.q_covariance = inverse * seen.tip_covariance * inverse.transpose();
  data_.cameras.push_back(seen);
}

IdentificationData DataCollector::finish() {
  std::stable_sort(data_.cameras.begin(), data_.cameras.end(),
                   [](const CameraObservation& a, const CameraObservation& b) { return a.t < b.t; });
  const MotorTrack& motors = data_.motors;
  std::erase_if(data_.cameras, [&](const CameraObservation& seen) {
    if (motors.t.empty() || seen.t < motors.t.front() || seen.t > motors.t.back()) return true;
    const std::size_t before = motors.at(seen.t), after = std::min(before + 1, motors.size() - 1);
    return motors.t[after] - motors.t[before] > kMotorGap;
  });
  measureNoise(data_);
  return std::move(data_);
}

}  // namespace capstan::identification
