#include "core/identification/identifiability.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <cmath>

#include "core/base/units.h"

namespace capstan::identification {
namespace {

constexpr double kBoundUp = 0.7;  // correlation from which on two unknowns are hard to distinguish

/// Angle or length of joint 0…2 as text [deg or mm].
std::string shown(int joint, double value) {
  return joint < 2 ? fmt::format("{:.2g} deg", base::toDegrees(value))
                   : fmt::format("{:.2g} mm", base::toMillimetres(value));
}

/// Relative standard deviation [%] of a logarithm's σ: two digits, or no decimals from 10 % on.
std::string perCent(double sigma) {
  const double value = 100.0 * std::expm1(sigma);
  return value < 10.0 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

/// Sentence on the motion that determines a parameter.
const char* remedyFor(Quantity quantity) {
  switch (quantity) {
    case Quantity::kLinkRadius:
      return "Move that joint over a wider range.";
    case Quantity::kStiffness:
      return "Load the joint: reach farther out, accelerate harder, or record longer.";
    case Quantity::kDamping:
      return "Move faster and reverse more often.";
    default:
      return "Reverse more often.";
  }
}

}  // namespace

std::string wordsOf(const ParameterSet& set, int unknown) {
  if (unknown < set.size()) return set[unknown].words();
  const int of_camera = unknown - set.size();
  if (of_camera == CameraPose::kSize - 1) return "the camera's delay";
  return fmt::format("the camera's {} {}", of_camera < 3 ? "rotation about" : "shift along",
                     std::string(1, "xyz"[of_camera % 3]));
}

Weakness weaknessOf(const ParameterSet& set, int i, const Visibility& v, int observations) {
  const Parameter& parameter = set[i];
  if (observations == 0) return Weakness::kNoObservations;
  const double seen = kSeenShare * parameter.prior_sigma;
  const double wanted = v.stated < seen ? std::min(seen, parameter.goal) : seen;
  if (v.sigma_alone > wanted) return Weakness::kSmallEffect;
  if (v.sigma > wanted && v.partner >= 0 && std::abs(v.correlation) > kBoundUp) return Weakness::kCorrelated;
  return v.stated >= parameter.prior_sigma ? Weakness::kNoBetter : Weakness::kHidden;
}

std::string adviceFor(const ParameterSet& set, int i, const Visibility& v, int observations) {
  const Parameter& parameter = set[i];
  const std::string words = parameter.words(), remedy = remedyFor(parameter.quantity);
  switch (weaknessOf(set, i, v, observations)) {
    case Weakness::kNoObservations:
      return words + " keeps its value, because no camera observation can be used.";
    case Weakness::kSmallEffect:
      return fmt::format(
          "{} has too small an effect in this motion. A value that is {:.0f} % larger moves joint {} by {} "
          "(RMS). The camera noise is {} in each of {} images. {}",
          words, 100.0 * std::expm1(parameter.prior_sigma), parameter.joint + 1,
          shown(parameter.joint, v.moved), shown(parameter.joint, v.noise), observations, remedy);
    case Weakness::kCorrelated:
      return fmt::format("{} cannot be distinguished from {} in this motion (correlation {:.2f}). {}", words,
                         wordsOf(set, v.partner), v.correlation, remedy);
    case Weakness::kNoBetter:
      return fmt::format("{} is known no better than before the recording. {}", words, remedy);
    default:
      return fmt::format(
          "{} is known to {} % (1 σ) only. Friction and hysteresis that the model does not contain move "
          "joint "
          "{}, too. {}",
          words, perCent(v.stated), parameter.joint + 1, remedy);
  }
}

void findPartner(const Eigen::MatrixXd& covariance, int i, int count, Visibility& visibility) {
  visibility.partner = -1;
  for (int j = 0; j < count; ++j) {
    const double correlation = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
    if (j == i || (visibility.partner >= 0 && std::abs(correlation) <= std::abs(visibility.correlation)))
      continue;
    visibility.partner = j;
    visibility.correlation = correlation;
  }
}

Identifiability assess(const OutputError& problem, const ParameterSet& set, const Eigen::MatrixXd& jacobian) {
  const int n = problem.unknowns();
  Identifiability found;
  found.observations = problem.observations();
  const Eigen::MatrixXd normal =
      jacobian.rows() > 0 ? Eigen::MatrixXd(jacobian.transpose() * jacobian) : Eigen::MatrixXd::Zero(n, n);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(normal, Eigen::ComputeFullV);
  found.singular_values = svd.singularValues().cwiseSqrt();
  found.directions = svd.matrixV();
  const Eigen::MatrixXd posterior = (normal + Eigen::MatrixXd::Identity(n, n)).inverse();

  for (int i = 0; i < set.size(); ++i) {
    Visibility v;
    const double prior = set[i].prior_sigma;
    v.sigma_alone = prior / std::sqrt(1.0 + normal(i, i));
    v.sigma = prior * std::sqrt(posterior(i, i));
    v.stated = v.sigma;
    v.seen = v.stated < kSeenShare * prior;
    double moved = 0.0, noise = 0.0;
    for (int k = 0; k < problem.observations(); ++k) {
      const double change =
          prior * problem.predictions()[static_cast<std::size_t>(k)].q_by_log(set[i].joint, i);
      moved += change * change;
      noise += problem.observation(k).q_covariance(set[i].joint, set[i].joint);
    }
    const double count = std::max(1, problem.observations());
    v.moved = std::sqrt(moved / count);
    v.noise = std::sqrt(noise / count);
    findPartner(posterior, i, n, v);
    if (!v.seen) v.advice = adviceFor(set, i, v, problem.observations());
    found.parameters.push_back(v);
  }
  return found;
}

}  // namespace capstan::identification
