#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/stats/interval.h"

namespace capstan::stats {

/// A number from a sample: rms, mean, median, …; finite for every resample.
using Statistic = std::function<double(std::span<const double>)>;

enum class Blocks {
  kMoving,    ///< only blocks that lie within the recording (Künsch 1989); its ends are drawn less often
  kCircular,  ///< the recording's end joined to its start (Politis and Romano 1992); every sample equally
              ///< often
};

/// Lengths of the pieces of a recording with gaps, in order: they add up to its samples. Empty: no gap.
using Pieces = std::vector<std::size_t>;

struct BootstrapOptions {
  Blocks blocks = Blocks::kCircular;  ///< of a recording without gaps
  std::size_t block_length =
      0;  ///< samples, up to the recording's; 0: defaultBlockLength; 1: independent samples
  std::size_t resamples = 2000;  ///< at least 2
  double confidence = 0.95;
  Pieces pieces = {};         ///< of the recording, or of a difference's first one
  Pieces second_pieces = {};  ///< of bootstrapDifference's second one; a pair's are alike
};

struct BootstrapReport {
  double estimate = 0.0;        ///< of the samples themselves
  double standard_error = 0.0;  ///< standard deviation of the resamples' values
  Interval interval;            ///< percentile interval: quantiles (type 7) (1 ± confidence)/2 of the values
  std::vector<double> replicates;  ///< the resamples' values in the order drawn
};

/// round(n^(1/3)), at least 1: the rate at which the error of a block bootstrap's variance is least (Hall,
/// Horowitz and Jing 1995). Correlation over many more samples than this asks for longer blocks.
std::size_t defaultBlockLength(std::size_t n);

/// Block bootstrap of a statistic of one recording of equally spaced, dependent samples: ⌈n/l⌉ blocks of
/// length l with starts drawn uniformly, cut to n samples, for each resample. Across gaps no block reaches:
/// starts are drawn from l − 1 samples before each piece on, blocks are what of them lies in the piece, and
/// every sample is drawn equally often. Same samples, options and state
/// of `random`, same report. base::InputError: no samples, one not finite, an option out of range, a
/// statistic not finite, pieces that are empty or do not add up.
BootstrapReport bootstrap(std::span<const double> values, const Statistic& statistic,
                          const BootstrapOptions& options, base::Random& random);

/// statistic(first) − statistic(second) of two independent recordings, each resampled by itself (and with its
/// own default block length). Errors as bootstrap.
BootstrapReport bootstrapDifference(std::span<const double> first, std::span<const double> second,
                                    const Statistic& statistic, const BootstrapOptions& options,
                                    base::Random& random);

/// The same of two signals of one recording, resampled by the same blocks, so that what they share cancels.
/// base::InputError as bootstrap, and for different lengths.
BootstrapReport bootstrapPairedDifference(std::span<const double> first, std::span<const double> second,
                                          const Statistic& statistic, const BootstrapOptions& options,
                                          base::Random& random);

}  // namespace capstan::stats
