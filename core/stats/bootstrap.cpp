#include "core/stats/bootstrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/stats/quantile.h"
#include "core/stats/rms.h"
#include "core/stats/samples.h"

namespace capstan::stats {
namespace {

[[noreturn]] void refuse(const char* key, std::string value, std::string reason, const char* remedy) {
  throw base::InputError({{}, 0, key, std::move(value), std::move(reason), remedy});
}

/// Sampler that draws the sample indices of each resample of n samples.
class BlockSampler {
 public:
  BlockSampler(std::size_t n, const BootstrapOptions& options, const Pieces& pieces)
      : n_(n), length_(options.block_length == 0 ? defaultBlockLength(n) : options.block_length) {
    if (length_ > n)
      refuse("block length", fmt::format("{}", length_), fmt::format("is longer than the {} samples", n),
             "Give a shorter one, or 0 for the default");
    starts_ = n;
    indices_.resize(n);
    if (!pieces.empty()) cutAt(pieces);
  }

  void draw(base::Random& random) {
    if (!pieces_.empty()) return drawWithin(random);
    for (std::size_t filled = 0; filled < n_;) {
      const std::size_t start = random.bits() % starts_;  // bias below n/2^64
      for (std::size_t k = 0; k < length_ && filled < n_; ++k) indices_[filled++] = (start + k) % n_;
    }
  }

  /// Sets `chosen` to the samples that the last draw() chose.
  void choose(std::span<const double> values, std::vector<double>& chosen) const {
    chosen.resize(n_);
    std::transform(indices_.begin(), indices_.end(), chosen.begin(),
                   [&](std::size_t i) { return values[i]; });
  }

 private:
  struct Piece {
    std::size_t begin, end;  ///< range of samples [begin, end)
    std::size_t starts;      ///< number of block starts in this piece and in all pieces before it
  };

  /// Sets `pieces_` and `starts_`. A single piece is the whole recording, which has no gap.
  void cutAt(const Pieces& lengths) {
    std::size_t begin = 0, starts = 0;
    for (const std::size_t length : lengths) {
      if (length == 0) refuse("pieces", "an empty one", "holds no sample", "Remove pieces without samples");
      starts += length + length_ - 1;
      pieces_.push_back({begin, begin + length, starts});
      begin += length;
    }
    if (begin != n_)
      refuse("pieces", fmt::format("{} samples", begin), fmt::format("are not the recording's {}", n_),
             "Give the length of each piece");
    if (lengths.size() > 1)
      starts_ = starts;
    else
      pieces_.clear();
  }

  void drawWithin(base::Random& random) {
    for (std::size_t filled = 0; filled < n_;) {
      const std::size_t start = random.bits() % starts_;
      const Piece& piece = *std::upper_bound(pieces_.begin(), pieces_.end(), start,
                                             [](std::size_t s, const Piece& one) { return s < one.starts; });
      // End of the block (exclusive), counted from the begin of the piece: 1 … its length + l − 1.
      const std::size_t behind = piece.starts - start;
      const std::size_t end = std::min(piece.begin + behind, piece.end);
      for (std::size_t k = behind > length_ ? piece.begin + behind - length_ : piece.begin;
           k < end && filled < n_; ++k)
        indices_[filled++] = k;
    }
  }

  std::size_t n_;
  std::size_t length_;
  std::vector<Piece> pieces_;  ///< empty when there is no gap
  std::size_t starts_ = 1;
  std::vector<std::size_t> indices_;
};

double finite(double value) {
  if (!std::isfinite(value))
    refuse("statistic", fmt::format("{}", value), "is not finite for a resample",
           "Choose a statistic that every resample has");
  return value;
}

/// Report of the values of `replicate`, which is called once per resample.
BootstrapReport reportOf(double estimate, const BootstrapOptions& options,
                         const std::function<double()>& replicate) {
  requireConfidence(options.confidence);
  if (options.resamples < 2)
    refuse("resamples", fmt::format("{}", options.resamples), "are too few for an interval",
           "Ask for 1000 or more");
  BootstrapReport report;
  report.estimate = finite(estimate);
  report.replicates.resize(options.resamples);
  for (double& value : report.replicates) value = finite(replicate());
  report.standard_error = standardDeviation(report.replicates);
  const double shares[] = {(1.0 - options.confidence) / 2.0, (1.0 + options.confidence) / 2.0};
  const std::vector<double> ends = quantiles(report.replicates, shares);
  report.interval = {ends[0], ends[1]};
  return report;
}

}  // namespace

std::size_t defaultBlockLength(std::size_t n) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(n)))));
}

BootstrapReport bootstrap(std::span<const double> values, const Statistic& statistic,
                          const BootstrapOptions& options, base::Random& random) {
  requireSamples(values, 1, "bootstrap");
  BlockSampler sampler(values.size(), options, options.pieces);
  std::vector<double> chosen;
  return reportOf(statistic(values), options, [&] {
    sampler.draw(random);
    sampler.choose(values, chosen);
    return statistic(chosen);
  });
}

BootstrapReport bootstrapDifference(std::span<const double> first, std::span<const double> second,
                                    const Statistic& statistic, const BootstrapOptions& options,
                                    base::Random& random) {
  requireSamples(first, 1, "first sample");
  requireSamples(second, 1, "second sample");
  BlockSampler of_first(first.size(), options, options.pieces);
  BlockSampler of_second(second.size(), options, options.second_pieces);
  std::vector<double> chosen;
  return reportOf(statistic(first) - statistic(second), options, [&] {
    of_first.draw(random);
    of_first.choose(first, chosen);
    const double value = statistic(chosen);
    of_second.draw(random);
    of_second.choose(second, chosen);
    return value - statistic(chosen);
  });
}

BootstrapReport bootstrapPairedDifference(std::span<const double> first, std::span<const double> second,
                                          const Statistic& statistic, const BootstrapOptions& options,
                                          base::Random& random) {
  if (first.size() != second.size())
    refuse("paired bootstrap", fmt::format("{} and {} samples", first.size(), second.size()),
           "every sample needs its partner", "Give two signals of one recording");
  requireSamples(first, 1, "first sample");
  requireSamples(second, 1, "second sample");
  BlockSampler sampler(first.size(), options, options.pieces);
  std::vector<double> chosen;
  return reportOf(statistic(first) - statistic(second), options, [&] {
    sampler.draw(random);
    sampler.choose(first, chosen);
    const double value = statistic(chosen);
    sampler.choose(second, chosen);
    return value - statistic(chosen);
  });
}

}  // namespace capstan::stats
