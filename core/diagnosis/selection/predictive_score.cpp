#include "core/diagnosis/selection/predictive_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace capstan::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ScoredChannels scoredChannels(const FitData& data, const Fit& at, const Weighting& weighting) {
  const std::vector<ComparedChannel>& of = data.channels();
  ScoredChannels channels{{data.sensorOf().begin(), data.sensorOf().end()},
                          VectorXd(static_cast<Index>(of.size())),
                          inputNoise(data, at, weighting),
                          torqueNoise(data, at, weighting)};
  for (std::size_t c = 0; c < of.size(); ++c) channels.noise[static_cast<Index>(c)] = of[c].noise;
  return channels;
}

PredictiveScore::PredictiveScore(const ScoredChannels& channels, Index blocks, int draws, std::uint64_t seed)
    : group_(channels.sensor) {
  const Index count = group_.empty() ? 0 : 1 + *std::ranges::max_element(group_);
  VectorXd in_group = VectorXd::Zero(count);
  parts_.resize(static_cast<std::size_t>(count));
  for (Index c = 0; c < channels.noise.size(); ++c) {
    const Index g = group_[static_cast<std::size_t>(c)];
    GroupNoise& part = parts_[static_cast<std::size_t>(g)];
    part.sensor += std::pow(channels.noise[c], 2);
    part.input += std::pow(channels.input.rms[c], 2);
    part.torque += std::pow(channels.torque.rms[c], 2);
    part.input_correlation = std::max(part.input_correlation, channels.input.correlation[c]);
    part.torque_correlation = std::max(part.torque_correlation, channels.torque.correlation[c]);
    in_group[g] += 1.0;
  }
  noise_ = floor_ = VectorXd(count);
  for (Index g = 0; g < count; ++g) {
    GroupNoise& part = parts_[static_cast<std::size_t>(g)];
    for (double* variance : {&part.sensor, &part.input, &part.torque}) *variance /= in_group[g];
    noise_[g] = std::max(part.sensor + part.input, std::numeric_limits<double>::min());
    floor_[g] = std::max(kSensorConfidence * part.sensor + part.input, std::numeric_limits<double>::min());
  }
  inflation_ = best_ = VectorXd::Constant(count, std::numeric_limits<double>::infinity());
  times_ = MatrixXd::Zero(blocks, draws);
  base::Random random(seed, "block bootstrap");
  for (Index d = 0; d < draws; ++d)
    for (Index b = 0; b < times_.rows(); ++b)
      times_(static_cast<Index>(random.bits() % static_cast<std::uint64_t>(times_.rows())), d) += 1.0;
}

double PredictiveScore::GroupNoise::inflation(double variance) const {
  const double unknown = std::clamp(variance - sensor - input, 0.0, torque);
  const double correlated = std::sqrt(input_correlation) * input + std::sqrt(torque_correlation) * unknown;
  const double sum = sensor + input + unknown;
  if (!(sum > 0.0)) return 1.0;
  return (sensor * sensor + 2.0 * sensor * (input + unknown) + correlated * correlated) / (sum * sum);
}

void PredictiveScore::learnInflation(const BlockSquares& squares) {
  if (squares.sum.size() == 0 || !squares.sum.allFinite()) return;
  VectorXd own = VectorXd::Zero(inflation_.size());
  for (std::size_t c = 0; c < group_.size(); ++c)
    own[group_[c]] = std::max(own[group_[c]], squares.inflation[static_cast<Index>(c)]);
  const VectorXd variance = variances(squares).cwiseMax(noise_);
  for (Index g = 0; g < own.size(); ++g) {
    if (variance[g] > best_[g]) continue;
    own[g] = std::max(own[g], parts_[static_cast<std::size_t>(g)].inflation(variance[g]));
    inflation_[g] = variance[g] < best_[g] ? own[g] : std::min(inflation_[g], own[g]);
    best_[g] = variance[g];
  }
}

double PredictiveScore::of(const BlockSquares& squares) const {
  if (squares.sum.size() == 0 || !squares.sum.allFinite()) return -std::numeric_limits<double>::infinity();
  return scores(pooled(squares.sum.rowwise().sum()), pooled(squares.count.rowwise().sum()), floor_)[0];
}

double PredictiveScore::mostGain(const BlockSquares& squares, double share) const {
  constexpr double kMost = 1.0 - 1e-6;  // nothing removes all
  const MatrixXd count = pooled(squares.count.rowwise().sum());
  const double samples = count.col(0).cwiseQuotient(inflation_).sum();
  return std::min(-0.5 * kBeyondTest * samples * std::log1p(-std::min(share, kMost)), room(squares));
}

double PredictiveScore::room(const BlockSquares& squares) const {
  const MatrixXd sum = pooled(squares.sum.rowwise().sum()), count = pooled(squares.count.rowwise().sum());
  return (scores(MatrixXd::Zero(sum.rows(), 1), count, noise_) - scores(sum, count, noise_))[0];
}

VectorXd PredictiveScore::variances(const BlockSquares& squares) const {
  const MatrixXd sum = pooled(squares.sum.rowwise().sum()), count = pooled(squares.count.rowwise().sum());
  return sum.col(0).cwiseQuotient(count.col(0).cwiseMax(1.0));
}

double PredictiveScore::excess(const BlockSquares& squares) const {
  return std::sqrt(variances(squares).cwiseQuotient(noise_).maxCoeff());
}

VectorXd PredictiveScore::ofDraws(const BlockSquares& squares) const {
  return scores(pooled(squares.sum * times_), pooled(squares.count * times_), floor_);
}

MatrixXd PredictiveScore::pooled(const MatrixXd& by_channel) const {
  MatrixXd all = MatrixXd::Zero(floor_.size(), by_channel.cols());
  for (std::size_t c = 0; c < group_.size(); ++c) all.row(group_[c]) += by_channel.row(static_cast<Index>(c));
  return all;
}

VectorXd PredictiveScore::scores(const MatrixXd& sum, const MatrixXd& count, const VectorXd& floor) const {
  VectorXd score = VectorXd::Zero(sum.cols());
  for (Index d = 0; d < sum.cols(); ++d)
    for (Index g = 0; g < sum.rows(); ++g) {
      const double n = count(g, d);
      if (n > 0.0) score[d] -= 0.5 * n / inflation_[g] * std::log(std::max(sum(g, d) / n, floor[g]));
    }
  return score;
}

}  // namespace capstan::diagnosis
