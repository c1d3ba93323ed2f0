#include "core/diagnosis/residuals/decimated_residual.h"

#include <algorithm>
#include <cmath>

#include "core/stats/block_length.h"
#include "core/stats/rms.h"

namespace capstan::diagnosis {

Decimated decimate(const Channel& channel, std::size_t most) {
  Decimated kept;
  const std::size_t stride = std::max<std::size_t>(1, (channel.size() + most - 1) / most);
  kept.period = channel.period * static_cast<double>(stride);
  for (std::size_t i = stride / 2; i < channel.size(); i += stride) {
    kept.samples.push_back(i);
    kept.residual.push_back(channel.residual[i]);
  }
  return kept;
}

TimeBlocks timeBlocks(const Channel& channel) {
  TimeBlocks blocks;
  if (channel.size() == 0) return blocks;
  const Decimated thin = decimate(channel, kForCorrelation);
  const double span = channel.period * static_cast<double>(channel.size());
  const auto samples = static_cast<double>(stats::optimalBlockLength(thin.residual));
  blocks.length =
      std::max(channel.period, std::min(samples * thin.period, span / static_cast<double>(kFewestBlocks)));
  blocks.begin.push_back(channel.t.front());
  for (const double t : channel.t) {
    const double passed = std::floor((t - blocks.begin.back()) / blocks.length + 1e-9);
    if (passed >= 1.0) blocks.begin.push_back(blocks.begin.back() + passed * blocks.length);
    blocks.index.push_back(static_cast<std::uint32_t>(blocks.begin.size() - 1));
  }
  blocks.count = blocks.begin.size();
  return blocks;
}

double effectiveSamples(std::span<const double> values, const TimeBlocks& blocks) {
  const auto n = static_cast<double>(values.size()), k = static_cast<double>(blocks.count);
  if (values.size() < 2 || blocks.count < 2) return 1.0;
  const double mean = stats::mean(values), variance = stats::variance(values);
  if (!(variance > 0.0)) return 1.0;
  std::vector<double> sums(blocks.count, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) sums[blocks.index[i]] += values[i] - mean;
  double squares = 0.0;
  for (const double sum : sums) squares += sum * sum;
  const double of_mean = squares / (n * n) * k / (k - 1.0);
  return of_mean > 0.0 ? std::clamp(variance / of_mean, 1.0, n) : n;
}

}  // namespace capstan::diagnosis
