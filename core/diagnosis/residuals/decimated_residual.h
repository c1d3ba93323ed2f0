#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/diagnosis/residuals/residual.h"

namespace capstan::diagnosis {

/// Every k-th sample of a channel. Samples are not averaged, so that fast parts keep their amplitude.
struct Decimated {
  double period = 0.0;               ///< typical time between the selected samples [s]
  std::vector<std::size_t> samples;  ///< indices of the selected samples in the channel
  std::vector<double> residual;
};
/// Decimates with the smallest k that gives at most `most` samples.
Decimated decimate(const Channel& channel, std::size_t most);

/// Division of a channel into blocks of equal duration, long enough that neighbours are nearly independent.
struct TimeBlocks {
  double length = 0.0;               ///< duration of a block [s]
  std::size_t count = 0;             ///< number of blocks with samples
  std::vector<std::uint32_t> index;  ///< block of each sample, from 0
  std::vector<double> begin;         ///< start of each block [s]
};

/// Time blocks for a block bootstrap of the residual's mean. Their duration is stats::optimalBlockLength() of
/// the residual decimated to kForCorrelation samples, but at most 1/kFewestBlocks of the channel's duration.
TimeBlocks timeBlocks(const Channel& channel);
inline constexpr std::size_t kForCorrelation = 1500;
inline constexpr std::size_t kFewestBlocks = 20;

/// Effective number of samples of a correlated series for its mean: variance of the series over the variance
/// of its mean. The latter follows from the scatter of the block sums (cluster-robust, Liang and Zeger 1986).
/// The result is between 1 and n.
double effectiveSamples(std::span<const double> values, const TimeBlocks& blocks);

}  // namespace capstan::diagnosis
