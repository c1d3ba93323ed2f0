#include "core/diagnosis/residuals/block_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace capstan::diagnosis {
namespace {

/// Predictions of the fitted half: the residual's mean in each bin, and its mean over all bins.
struct Prediction {
  std::vector<double> bins;
  double mean = 0.0;
};

/// Variance of the mean of one block in a bin, pooled over the bins.
double pooledVariance(const std::vector<BinMean>& means) {
  double scatter = 0.0, weights = 0.0;
  for (const BinMean& bin : means)
    if (bin.worth > 1.5) scatter += bin.scatter * bin.worth / (bin.worth - 1.0), weights += bin.weights;
  return weights > 0.0 ? scatter / weights : std::numeric_limits<double>::infinity();
}

/// Variance between the true means of the bins, from that of the estimated means (DerSimonian and Laird
/// 1986).
struct BetweenBins {
  double variance = 0.0, centre = 0.0;
};
BetweenBins betweenBins(const std::vector<BinMean>& means, double of_block) {
  double w = 0.0, w2 = 0.0, wm = 0.0, count = 0.0;
  for (const BinMean& bin : means) {
    const double weight = bin.worth / of_block;
    w += weight, w2 += weight * weight, wm += weight * bin.mean, count += bin.worth > 0.0;
  }
  if (!(w > 0.0)) return {};
  BetweenBins between{0.0, wm / w};
  double q = 0.0;
  for (const BinMean& bin : means)
    q += bin.worth / of_block * (bin.mean - between.centre) * (bin.mean - between.centre);
  const double spread = w - w2 / w;
  if (spread > 0.0) between.variance = std::max(0.0, (q - (count - 1.0)) / spread);
  return between;
}

/// Gives each bin without samples in the fitted half the prediction of the nearest bin with samples.
void takeFromNeighbours(const std::vector<BinMean>& means, Prediction& prediction) {
  const std::size_t n = means.size();
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t away = 1; away < n && means[b].worth == 0.0; ++away) {
      const bool below = b >= away && means[b - away].worth > 0.0;
      const bool above = b + away < n && means[b + away].worth > 0.0;
      if (!below && !above) continue;
      const double low = prediction.bins[below ? b - away : b + away];
      const double high = prediction.bins[above ? b + away : b - away];
      prediction.bins[b] = 0.5 * (low + high);
      break;
    }
}

Prediction fit(const BlockTable& table, const std::vector<bool>& member) {
  const std::vector<BinMean> means = binMeans(table, member);
  Cell all;
  for (const BinMean& bin : means) all += bin.all;
  Prediction prediction{std::vector<double>(means.size(), 0.0), all.n > 0.0 ? all.sum / all.n : 0.0};
  const double of_block = pooledVariance(means);
  // Without any scatter the bins' means are exact; with too few blocks in every bin they are unknown.
  const bool exact = of_block == 0.0, unknown = !std::isfinite(of_block);
  const BetweenBins between = exact || unknown ? BetweenBins{} : betweenBins(means, of_block);
  for (std::size_t b = 0; b < means.size(); ++b) {
    prediction.bins[b] = prediction.mean;
    if (means[b].worth == 0.0 || unknown) continue;
    const double keep = exact ? 1.0 : between.variance / (between.variance + of_block / means[b].worth);
    const double centre = between.variance > 0.0 ? between.centre : prediction.mean;
    prediction.bins[b] = exact ? means[b].mean : centre + keep * (means[b].mean - centre);
  }
  takeFromNeighbours(means, prediction);
  return prediction;
}

}  // namespace

BlockTable::BlockTable(std::span<const double> residual, std::span<const double> variable,
                       const TimeBlocks& blocks, std::span<const double> edges)
    : bins_(edges.size() - 1), cells_(blocks.count * bins_), squares_(blocks.count, 0.0) {
  const auto inner = edges.subspan(1, edges.size() - 2);
  for (std::size_t i = 0; i < residual.size(); ++i) {
    const std::size_t block = blocks.index[i];
    const auto bin =
        static_cast<std::size_t>(std::upper_bound(inner.begin(), inner.end(), variable[i]) - inner.begin());
    cells_[block * bins_ + bin] += {1.0, residual[i], variable[i]};
    squares_[block] += residual[i] * residual[i];
  }
}

double BinMean::variance() const {
  if (worth < 2.0 - 1e-9) return std::numeric_limits<double>::quiet_NaN();
  return scatter / (all.n * all.n) * worth / (worth - 1.0);
}

std::vector<BinMean> binMeans(const BlockTable& table, const std::vector<bool>& member) {
  std::vector<BinMean> means(table.bins());
  for (std::size_t b = 0; b < table.bins(); ++b) {
    BinMean& bin = means[b];
    for (std::size_t k = 0; k < table.blocks(); ++k)
      if (member[k]) bin.all += table.at(k, b);
    if (bin.all.n == 0.0) continue;
    bin.mean = bin.all.sum / bin.all.n;
    for (std::size_t k = 0; k < table.blocks(); ++k) {
      if (!member[k]) continue;
      const Cell& cell = table.at(k, b);
      bin.scatter += std::pow(cell.sum - cell.n * bin.mean, 2);
      bin.weights += cell.n * cell.n;
    }
    bin.worth = bin.all.n * bin.all.n / bin.weights;
  }
  return means;
}

CrossValidated crossValidatedShare(const BlockTable& table, const std::vector<bool>& half,
                                   const std::vector<std::size_t>& segment) {
  const std::size_t segments = segment.empty() ? 0 : segment.back() + 1;
  std::vector<double> gain(segments, 0.0), total(segments, 0.0);
  for (const bool fitted : {false, true}) {
    std::vector<bool> member(half);
    if (!fitted) member.flip();
    const Prediction prediction = fit(table, member);
    const double mean = prediction.mean;
    for (std::size_t k = 0; k < table.blocks(); ++k) {
      if (member[k]) continue;
      double& error = total[segment[k]];
      error += table.squares(k);
      for (std::size_t b = 0; b < table.bins(); ++b) {
        const Cell& cell = table.at(k, b);
        const double p = prediction.bins[b];
        error += mean * (mean * cell.n - 2.0 * cell.sum);
        gain[segment[k]] += (mean - p) * ((mean + p) * cell.n - 2.0 * cell.sum);
      }
    }
  }
  double gained = 0.0, of = 0.0, scatter = 0.0;
  for (std::size_t s = 0; s < segments; ++s) gained += gain[s], of += total[s];
  if (!(of > 0.0)) return {};
  const double share = gained / of;
  for (std::size_t s = 0; s < segments; ++s) scatter += std::pow(gain[s] - share * total[s], 2);
  const auto count = static_cast<double>(segments);
  return {share, count > 1.0 ? std::sqrt(scatter * count / (count - 1.0)) / of : 0.0};
}

}  // namespace capstan::diagnosis
