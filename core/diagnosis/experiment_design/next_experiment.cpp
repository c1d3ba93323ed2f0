#include "core/diagnosis/experiment_design/next_experiment.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.h"
#include "core/diagnosis/experiment_design/motion_evidence.h"
#include "core/diagnosis/experiment_design/test_motion.h"
#include "core/diagnosis/report/report_tables.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kHardly = 0.9;   // share of today's confusion above which a motion is of no use
constexpr double kOutput = 0.01;  // step of the trajectory that is written [s]

/// Parameters of one set in a new recording.
struct Prediction {
  FitModel model;
  VectorXd u;
  MatrixXd root;  ///< L of the covariance C = L Lᵀ
  double probability = 0.0;
};

bool happensOnce(const EffectTerm& term) {
  return std::ranges::any_of(term.hypothesis->facts->parameters, isEventTime);
}

/// Sets effects that happen once to zero, and their rows of the covariance too.
void leaveOutEvents(const FitModel& model, VectorXd& u, MatrixXd& covariance) {
  for (const EffectTerm& term : model.effects()) {
    if (!happensOnce(term)) continue;
    for (std::size_t k = 0; k < term.index.size(); ++k) {
      const int at = term.index[k];
      if (at < 0) continue;
      covariance.row(at).setZero();
      covariance.col(at).setZero();
      if (!isEventTime(term.hypothesis->facts->parameters[k]))
        u[at] = model.parameters()[static_cast<std::size_t>(at)].u(0.0);
    }
  }
}

MatrixXd rootOf(const MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

std::vector<Prediction> predictionsOf(const FitData& data, const Selection& selection) {
  const SetFitter fitter(data);
  std::vector<Prediction> all;
  double sum = 0.0;
  for (const ProbableSet& one : selection.probable) {
    SetFit set = one.set;
    fitter.relinearise(set);
    VectorXd u = set.fit.u;
    MatrixXd covariance = covarianceOf(data, set.fit, set.weighting);
    leaveOutEvents(set.fit.model, u, covariance);
    sum += one.probability;
    all.push_back({set.fit.model, std::move(u), rootOf(covariance), one.probability});
  }
  for (Prediction& one : all) one.probability /= sum;
  return all;
}

/// 1 / √(s² n) of each reading of a new recording: s is the larger of residual and noise of the same sensor
/// in the recordings, n the correlation length of the residual.
VectorXd weightsOf(const FitData& fresh, const FitData& data, const Selection& selection) {
  std::vector<double> weight;
  for (const ComparedChannel& channel : fresh.channels()) {
    double variance = 0.0, inflation = 1.0;
    for (std::size_t c = 0; c < data.channels().size(); ++c) {
      const ComparedChannel& other = data.channels()[c];
      if (other.joint != channel.joint || other.axis != channel.axis) continue;
      const auto row = static_cast<Index>(c);
      variance = std::max({variance, selection.best_squares.meanSquare(row), other.noise * other.noise});
      inflation = std::max(inflation, selection.best_squares.inflation[row]);
    }
    weight.push_back(1.0 / std::sqrt(std::max(variance * inflation, std::numeric_limits<double>::min())));
  }
  VectorXd weights(fresh.size());
  for (std::size_t i = 0; i < fresh.channel().size(); ++i)
    weights[static_cast<Index>(i)] = weight[static_cast<std::size_t>(fresh.channel()[i])];
  return weights;
}

/// D of the weighted difference d, with the weighted derivatives J L of the parameters that may take it up.
double distance(const VectorXd& d, const MatrixXd& scaled) {
  const MatrixXd normal = MatrixXd::Identity(scaled.cols(), scaled.cols()) + scaled.transpose() * scaled;
  const VectorXd along = scaled.transpose() * d;
  return std::max(0.0, d.squaredNorm() - along.dot(normal.ldlt().solve(along)));
}

/// Logarithm of the bound of the probability of a wrong choice after recording the motion; infinite if a
/// simulation diverged.
double logConfusion(const TestMotion& motion, const std::vector<Prediction>& sets, const FitData& data,
                    const std::vector<Evidence>& recordings, const Selection& selection,
                    const robot::Description& nominal, EncoderZeros zeros) {
  const std::vector<Evidence> evidence{motionEvidence(motion, nominal, recordings.front())};
  const EncoderZeros own = zeros == EncoderZeros::kKnown ? zeros : EncoderZeros::kOneForAll;
  const FitData fresh(evidence, nominal, 0.0, own, 1);
  const Weighting weighting{weightsOf(fresh, data, selection)};
  std::vector<VectorXd> readings;
  std::vector<MatrixXd> scaled;
  for (const Prediction& set : sets) {
    const Fit at = linearise(fresh, set.model, set.u, noneBeyond(fresh), weighting);
    if (!at.e.allFinite() || !at.jacobian.allFinite()) return std::numeric_limits<double>::infinity();
    readings.push_back(weighting.weights.cwiseProduct(at.e));
    scaled.push_back(weighting.weights.asDiagonal() * (at.jacobian * set.root));
  }
  std::vector<double> terms;
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = i + 1; j < sets.size(); ++j) {
      const VectorXd d = readings[i] - readings[j];
      const double apart = std::min(distance(d, scaled[i]), distance(d, scaled[j]));
      terms.push_back(0.5 * std::log(sets[i].probability * sets[j].probability) - apart / 8.0);
    }
  const double most = *std::ranges::max_element(terms);
  double sum = 0.0;
  for (const double term : terms) sum += std::exp(term - most);
  return most + std::log(sum);
}

/// Probability that the most probable set is the wrong one.
double confusionNow(const std::vector<Prediction>& sets) {
  double most = 0.0;
  for (const Prediction& set : sets) most = std::max(most, set.probability);
  return 1.0 - most;
}

/// Effects that are in some of the sets and not in all.
std::vector<NamedEffect> differencesOf(const Selection& selection) {
  EffectSet some;
  for (const ProbableSet& one : selection.probable)
    for (const EffectCandidate& effect : one.set.effects)
      if (!contains(some, effect)) some = plus(std::move(some), effect);
  std::erase_if(some, [&](const EffectCandidate& effect) {
    return std::ranges::all_of(selection.probable,
                               [&](const ProbableSet& one) { return contains(one.set.effects, effect); });
  });
  std::vector<NamedEffect> named;
  for (const EffectCandidate& effect : some)
    named.push_back({std::string(effect.hypothesis->name()), effect.joint});
  return named;
}

}  // namespace

std::optional<NextExperiment> nextExperiment(const FitData& data, const std::vector<Evidence>& recordings,
                                             const Selection& selection, const robot::Description& nominal,
                                             EncoderZeros zeros, int threads, base::Progress* progress) {
  if (data.rigid() || selection.probable.size() < 2) return std::nullopt;
  if (progress) progress->report(progress->fraction(), "Choosing the next experiment");
  const std::vector<Prediction> sets = predictionsOf(data, selection);
  const std::vector<TestMotion> motions = testMotions(nominal, recordings, recordings.front().step);
  std::vector<double> confusion(motions.size(), std::numeric_limits<double>::infinity());
  base::parallelFor(motions.size(), threads, [&](std::size_t k) {
    if (progress && progress->cancelled()) return;
    confusion[k] = logConfusion(motions[k], sets, data, recordings, selection, nominal, zeros);
  });
  if (progress && progress->cancelled()) return std::nullopt;
  const auto best = static_cast<std::size_t>(std::ranges::min_element(confusion) - confusion.begin());
  if (!std::isfinite(confusion[best])) return std::nullopt;
  const TestMotion& motion = motions[best];
  NextExperiment next{.motion = motion.title,
                      .distinguishes = differencesOf(selection),
                      .t = {},
                      .q = Columns(static_cast<std::size_t>(nominal.size())),
                      .confusion_now = confusionNow(sets),
                      .confusion_after = std::min(confusionNow(sets), std::exp(confusion[best]))};
  const auto every = static_cast<std::size_t>(std::max(1L, std::lround(kOutput / motion.step)));
  for (std::size_t k = 0; k < motion.q.size(); k += every) {
    next.t.push_back(motion.step * static_cast<double>(k));
    for (std::size_t j = 0; j < next.q.size(); ++j) next.q[j].push_back(motion.q[k][static_cast<Index>(j)]);
  }
  return next;
}

std::string trajectoryText(const NextExperiment& experiment) {
  std::string text = "t";
  for (std::size_t j = 0; j < experiment.q.size(); ++j) text += fmt::format(",q{}", j + 1);
  text += '\n';
  for (std::size_t k = 0; k < experiment.t.size(); ++k) {
    text += fmt::format("{:.4f}", experiment.t[k]);
    for (const std::vector<double>& q : experiment.q) text += fmt::format(",{:.9g}", q[k]);
    text += '\n';
  }
  return text;
}

std::string sentenceOf(const NextExperiment& experiment) {
  const auto percent = [](double share) {
    return share < 1e-3 ? std::string("less than 0.1 %") : fmt::format("{:.1f} %", 100.0 * share);
  };
  if (experiment.confusion_after > kHardly * experiment.confusion_now)
    return "No motion of the joints distinguishes the most probable models.";
  return fmt::format(
      "Next experiment: {} ({:.0f} s). With this recording, the probability of choosing a wrong one of the "
      "most "
      "probable models falls from {} to {}.",
      experiment.motion, experiment.t.empty() ? 0.0 : experiment.t.back(), percent(experiment.confusion_now),
      percent(experiment.confusion_after));
}

}  // namespace capstan::diagnosis
