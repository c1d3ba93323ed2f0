#include "core/identification/better_motion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.h"
#include "core/identification/batch.h"
#include "core/identification/output_error.h"
#include "core/robot/transmission.h"

namespace capstan::identification {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kShareOfSpeed = 0.8;  // of a joint's highest speed, reached at the steepest point
constexpr double kMargin = 0.05;       // of a joint's range that stays free at each limit
constexpr double kFrameRate = 15.0;    // [1/s]
constexpr double kHelps = 0.9;         // of a parameter's σ: what is left more has not become known
constexpr double kMotorRate = 500.0;   // [1/s]; motor angles are linear between samples
const ShootingOptions kPieces{.segment = 20.0, .threads = 1};

/// Amplitudes as shares of the free range, frequencies that no two joints have in common.
struct Pace {
  double share;
  Vector3d frequency;
};
const std::array kPaces = {Pace{0.9, Vector3d(0.11, 0.17, 0.23)}, Pace{0.4, Vector3d(0.31, 0.43, 0.53)},
                           Pace{0.2, Vector3d(0.83, 1.07, 1.31)}};
/// Middle, and reaching out and raised: place in each joint's free range, 0…1.
const std::array kPlaces = {Vector3d(0.5, 0.5, 0.5), Vector3d(0.35, 0.7, 0.7)};

/// What the cameras and motors of `like` would record of the motion.
IdentificationData recordingOf(const SinusoidMotion& motion, const IdentificationData& like,
                               const Eigen::Matrix3d& noise) {
  const robot::Transmission transmission(like.robot);
  const robot::ArmKinematics arm(like.robot);
  IdentificationData data;
  data.title = "proposed motion";
  data.robot = like.robot;
  data.images = like.images;
  const auto samples = static_cast<int>(motion.duration * kMotorRate);
  for (int k = 0; k <= samples; ++k) {
    const double t = k / kMotorRate;
    data.motors.t.push_back(t);
    data.motors.position.push_back(transmission.motorFromJoint(motion.at(t)));
    data.motors.velocity.push_back(
        (transmission.motorFromJoint(motion.at(t + 1e-3)) - data.motors.position.back()) / 1e-3);
  }
  for (double t = 0.0; t < motion.duration; t += 1.0 / kFrameRate) {
    const Vector3d q = motion.at(t);
    CameraObservation seen;
    seen.t = t;
    seen.tip = seen.tip_kin = arm.tip(q);
    seen.tip_covariance = noise;
    seen.q_cam = q;
    const Eigen::Matrix3d inverse = arm.tipJacobian(q).inverse();
    seen.q_covariance = inverse * noise * inverse.transpose();
    seen.open = true;
    data.cameras.push_back(seen);
  }
  return data;
}

std::optional<Eigen::Matrix3d> meanNoise(const IdentificationData& data) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double count = 0.0;
  for (const CameraObservation& seen : data.cameras) {
    if (!seen.open) continue;
    sum += seen.tip_covariance;
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return Eigen::Matrix3d(sum / count);
}

/// σ of the logarithms by the linear model at `logs`, without model discrepancy: in a moment, to order
/// motions by. Empty when cancelled.
std::vector<double> linearSigmas(const IdentificationData& data, const ParameterSet& set,
                                 const std::vector<double>& logs, const CameraPoseOptions& camera,
                                 const base::Progress& progress) {
  OutputError problem(data, set, camera, kPieces);
  VectorXd x = VectorXd::Zero(problem.unknowns()), residuals;
  for (int i = 0; i < set.size(); ++i) x(i) = logs[static_cast<std::size_t>(i)] / set[i].prior_sigma;
  MatrixXd jacobian;
  if (!problem.evaluate(x, residuals, &jacobian, &progress)) return {};
  const auto unknowns = jacobian.cols();
  const MatrixXd covariance =
      (jacobian.transpose() * jacobian + MatrixXd::Identity(unknowns, unknowns)).inverse();
  std::vector<double> sigmas;
  for (int i = 0; i < set.size(); ++i) sigmas.push_back(set[i].prior_sigma * std::sqrt(covariance(i, i)));
  return sigmas;
}

/// σ of the logarithms that the batch method would state for `data`, whose observations are set to the output
/// of the model at `logs`; empty when cancelled.
std::vector<double> sigmasBy(IdentificationData data, const ParameterSet& set,
                             const std::vector<double>& logs, const CameraPoseOptions& camera,
                             base::Progress& progress) {
  const robot::ArmKinematics arm(data.robot);
  const Shooting shooting(data, set, kPieces);
  std::vector<ArmPrediction> predictions;
  const ParameterSet::Logs at = Eigen::Map<const VectorXd>(logs.data(), set.size());
  if (!shooting.predict(at, false, predictions, &progress)) return {};
  for (std::size_t k = 0; k < predictions.size(); ++k) {
    CameraObservation& seen = data.cameras[shooting.used()[k]];
    seen.q_cam = predictions[k].q;
    seen.tip = arm.tip(seen.q_cam);
  }
  const BatchReport found =
      identifyBatch(data, set, {.camera = camera, .shooting = kPieces, .start = logs}, &progress);
  std::vector<double> sigmas;
  for (const Estimate& estimate : found.estimates) sigmas.push_back(estimate.sigma);
  return sigmas;
}

/// σ of every parameter when the information of both recordings adds; the prior counts once.
std::vector<double> combined(const std::vector<Estimate>& now, const std::vector<double>& by_motion) {
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double prior = now[i].parameter.prior_sigma;
    const double added = std::pow(by_motion[i], -2) - std::pow(prior, -2);
    sigmas.push_back(1.0 / std::sqrt(std::pow(now[i].sigma, -2) + std::max(0.0, added)));
  }
  return sigmas;
}

/// Sum of ln(σ / goal) of the weak parameters; what is better than the goal brings nothing more.
double costOf(const std::vector<double>& sigmas, const std::vector<int>& weak, const ParameterSet& set) {
  double cost = 0.0;
  for (const int i : weak) cost += std::max(0.0, std::log(sigmas[static_cast<std::size_t>(i)] / set[i].goal));
  return cost;
}

std::string wordsOf(const MotionProposal& proposal, const ParameterSet& set) {
  const SinusoidMotion& motion = proposal.motion;
  const auto degrees = [](double angle) { return fmt::format("{:.0f}°", base::toDegrees(angle)); };
  std::vector<std::string> gains;
  bool helps = false;
  for (const int i : proposal.weak) {
    const auto at = static_cast<std::size_t>(i);
    helps = helps || proposal.then[at] < kHelps * proposal.now[at];
    gains.push_back(fmt::format("{} from {:.2g} % to {:.2g} %", set[i].name(), 100.0 * proposal.now[at],
                                100.0 * proposal.then[at]));
  }
  return fmt::format(
      "{}The joints oscillate for {:.0f} s about {}, {}, {:.0f} mm by ±{}, ±{}, ±{:.0f} mm at {:.2f}, "
      "{:.2f}, "
      "{:.2f} Hz. The predicted change of σ is: {}.",
      helps ? "" : "No motion helps much. This is the best one. ", motion.duration, degrees(motion.centre(0)),
      degrees(motion.centre(1)), base::toMillimetres(motion.centre(2)), degrees(motion.amplitude(0)),
      degrees(motion.amplitude(1)), base::toMillimetres(motion.amplitude(2)), motion.frequency(0),
      motion.frequency(1), motion.frequency(2), fmt::join(gains, "; "));
}

}  // namespace

Vector3d SinusoidMotion::at(double t) const {
  const double edge = std::clamp(std::min(t, duration - t) / kRamp, 0.0, 1.0);
  const double ramp = edge * edge * edge * (10.0 - 15.0 * edge + 6.0 * edge * edge);
  Vector3d q = centre;
  for (int i = 0; i < 3; ++i)
    q(i) += ramp * amplitude(i) * std::sin(2.0 * std::numbers::pi * frequency(i) * t);
  return q;
}

std::vector<SinusoidMotion> candidateMotions(const robot::Description& robot) {
  std::vector<SinusoidMotion> motions;
  for (const Pace& pace : kPaces)
    for (const Vector3d& place : kPlaces) {
      SinusoidMotion motion;
      motion.frequency = pace.frequency;
      for (int i = 0; i < 3; ++i) {
        const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
        const double range = joint.limit_high - joint.limit_low;
        const double low = joint.limit_low + kMargin * range, high = joint.limit_high - kMargin * range;
        motion.centre(i) = low + place(i) * (high - low);
        const double room = std::min(motion.centre(i) - low, high - motion.centre(i));
        // The ramp is steep for a moment, too: 1.875 amplitude / kRamp.
        const double speed = 2.0 * std::numbers::pi * pace.frequency(i) + 1.875 / SinusoidMotion::kRamp;
        motion.amplitude(i) = std::min(pace.share * room, kShareOfSpeed * joint.max_speed / speed);
      }
      motions.push_back(motion);
    }
  return motions;
}

std::vector<int> weakOf(const std::vector<Estimate>& estimates) {
  std::vector<int> weak, unsettled;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!estimates[i].seen) weak.push_back(static_cast<int>(i));
    if (estimates[i].sigma > estimates[i].parameter.goal) unsettled.push_back(static_cast<int>(i));
  }
  return weak.empty() ? unsettled : weak;
}

std::optional<MotionProposal> proposeMotion(const IdentificationData& recorded, const ParameterSet& set,
                                            const std::vector<Estimate>& estimates,
                                            const CameraPoseOptions& camera, base::Progress& progress) {
  MotionProposal best;
  best.weak = weakOf(estimates);
  const auto noise = meanNoise(recorded);
  if (best.weak.empty() || !noise) return std::nullopt;
  std::vector<double> logs;
  for (const Estimate& estimate : estimates) {
    logs.push_back(estimate.seen ? estimate.log : 0.0);
    best.now.push_back(estimate.sigma);
  }
  double least = std::numeric_limits<double>::infinity();
  const auto candidates = candidateMotions(recorded.robot);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    progress.report(static_cast<double>(k) / static_cast<double>(candidates.size() + 1), "motions");
    const auto by_motion =
        linearSigmas(recordingOf(candidates[k], recorded, *noise), set, logs, camera, progress);
    if (by_motion.empty() || progress.cancelled()) return std::nullopt;
    const double cost = costOf(combined(estimates, by_motion), best.weak, set);
    if (cost >= least) continue;
    least = cost;
    best.motion = candidates[k];
  }
  const auto by_best = sigmasBy(recordingOf(best.motion, recorded, *noise), set, logs, camera, progress);
  if (by_best.empty() || progress.cancelled()) return std::nullopt;
  best.then = combined(estimates, by_best);
  best.words = wordsOf(best, set);
  return best;
}

}  // namespace capstan::identification
