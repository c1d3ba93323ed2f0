#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/diagnosis/residuals/residual.h"

namespace capstan::diagnosis {

/// Every so-manieth sample of a channel, at most `most` of them, not averaged: what is fast stays as large as
/// it is.
struct Decimated {
  double period = 0.0;               ///< between those kept, typically [s]
  std::vector<std::size_t> samples;  ///< indices
  std::vector<double> residual;
};
Decimated decimate(const Channel& channel, std::size_t most);

/// A channel cut into segments of one length in time, long enough that neighbours are nearly independent.
struct TimeBlocks {
  double length = 0.0;               ///< [s]
  std::size_t count = 0;             ///< blocks with samples in them
  std::vector<std::uint32_t> index;  ///< block of each sample, rising from 0 without a gap
  std::vector<double> begin;         ///< of each block [s]
};

/// Blocks of the length that suits a block bootstrap of the residual's mean (stats::optimalBlockLength of
/// the residual decimated to kForCorrelation samples), at most a kFewestBlocks-th of the channel's time.
TimeBlocks timeBlocks(const Channel& channel);
inline constexpr std::size_t kForCorrelation = 1500;
inline constexpr std::size_t kFewestBlocks = 20;

/// Samples that a dependent series is worth for its mean: its variance over that of its mean, the latter from
/// the spread of the blocks' sums (cluster-robust, Liang and Zeger 1986). Between 1 and n.
double effectiveSamples(std::span<const double> values, const TimeBlocks& blocks);

}  // namespace capstan::diagnosis
