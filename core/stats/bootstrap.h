#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/stats/interval.h"

namespace capstan::stats {

/// Function that computes a number from a sample (rms, mean, …); it must be finite for every resample.
using Statistic = std::function<double(std::span<const double>)>;

/// Numbers of samples of the pieces of a recording with gaps, in order; their sum is the number of samples of
/// the recording. Empty when the recording has no gap.
using Pieces = std::vector<std::size_t>;

struct BootstrapOptions {
  /// Samples per block, at most all of the recording; 0: defaultBlockLength(); 1: independent samples.
  std::size_t block_length = 0;
  std::size_t resamples = 2000;  ///< number of resamples, at least 2
  double confidence = 0.95;      ///< confidence of the interval, in (0, 1)
  Pieces pieces = {};            ///< pieces of the recording, or of the first of two
  Pieces second_pieces = {};     ///< pieces of the second recording of bootstrapDifference()
};

struct BootstrapReport {
  double estimate = 0.0;        ///< statistic of the samples themselves
  double standard_error = 0.0;  ///< standard deviation of `replicates`
  Interval interval;  ///< percentile interval: quantiles (1 ± confidence)/2 (type 7) of `replicates`
  std::vector<double> replicates;  ///< statistic of each resample, in the order drawn
};

/// Default block length, round(n^(1/3)) and at least 1: the growth with n for which a block bootstrap of a
/// variance has the smallest error (Hall, Horowitz and Jing 1995). Samples that are correlated over many more
/// samples than this need longer blocks.
std::size_t defaultBlockLength(std::size_t n);

/// Block bootstrap of a statistic of one recording of equally spaced, dependent samples. Each resample
/// consists of ⌈n/l⌉ blocks of length l with uniformly drawn starts, cut to n samples. Without gaps the
/// blocks are circular: the end of the recording is joined to its start (Politis and Romano 1992). With gaps
/// no block extends across one: for each piece, starts are drawn from l − 1 samples before its begin up to
/// its end, and each block is cut to the part that lies in the piece. Every sample is drawn equally often in
/// both cases. The same samples, options and state of `random` give the same report. Throws base::InputError
/// when there are no samples, a sample or the statistic is not finite, an option is out of range, or a piece
/// is empty or the pieces do not add up.
BootstrapReport bootstrap(std::span<const double> values, const Statistic& statistic,
                          const BootstrapOptions& options, base::Random& random);

/// Block bootstrap of statistic(first) − statistic(second) of two independent recordings. Each is resampled
/// separately (and with its own default block length). Throws as bootstrap().
BootstrapReport bootstrapDifference(std::span<const double> first, std::span<const double> second,
                                    const Statistic& statistic, const BootstrapOptions& options,
                                    base::Random& random);

/// Block bootstrap of statistic(first) − statistic(second) of two signals of one recording. Both are
/// resampled with the same blocks, so that their common variation cancels. Throws as bootstrap(), and when
/// the lengths differ.
BootstrapReport bootstrapPairedDifference(std::span<const double> first, std::span<const double> second,
                                          const Statistic& statistic, const BootstrapOptions& options,
                                          base::Random& random);

}  // namespace capstan::stats
