#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

#include "core/analysis/analysis.h"
#include "core/analysis/analysis_sides.h"
#include "core/base/error.h"
#include "core/stats/block_length.h"
#include "core/stats/bootstrap.h"
#include "core/stats/rms.h"
#include "core/stats/t_test.h"

namespace capstan::analysis {
namespace {

struct Cancelled {};

std::size_t lengthFor(std::span<const double> values) {
  std::vector<double> squares(values.size());
  std::transform(values.begin(), values.end(), squares.begin(), [](double x) { return x * x; });
  return std::max(stats::optimalBlockLength(values), stats::optimalBlockLength(squares));
}

/// Calls `take` with the samples of each piece.
template <class Take>
void forEachPiece(const SpacedErrors& errors, Take&& take) {
  std::size_t begin = 0;
  for (const std::size_t length : errors.pieces) {
    take(std::span(errors.value).subspan(begin, length));
    begin += length;
  }
}

/// Block length: the longer one of all samples and of the longest piece, because gaps hide correlation in all
/// samples.
std::size_t lengthFor(const SpacedErrors& errors) {
  std::span<const double> longest;
  forEachPiece(errors, [&](std::span<const double> piece) {
    if (piece.size() > longest.size()) longest = piece;
  });
  return std::max(lengthFor(std::span<const double>(errors.value)), lengthFor(longest));
}

/// Means of the whole blocks of each piece. A piece of one block or less gives its own mean, if it has at
/// least half the samples of a block or of the longest piece: a block cannot continue beyond a gap.
std::vector<double> blockMeans(const SpacedErrors& errors, std::size_t length) {
  const std::size_t longest = *std::max_element(errors.pieces.begin(), errors.pieces.end());
  const std::size_t least = (std::min(length, longest) + 1) / 2;
  std::vector<double> means;
  forEachPiece(errors, [&](std::span<const double> piece) {
    if (piece.size() < least) return;
    const std::size_t blocks = std::max<std::size_t>(1, piece.size() / length);
    const std::size_t size = blocks > 1 ? length : piece.size();
    for (std::size_t i = 0; i < blocks; ++i) means.push_back(stats::mean(piece.subspan(i * size, size)));
  });
  return means;
}

void addProbability(AnalysisRow& row, const Sides& sides) {
  const auto first = blockMeans(sides.first, row.block_length);
  const auto second = blockMeans(sides.second, row.block_length);
  row.blocks = std::min(first.size(), second.size());
  if (row.blocks < AnalysisRow::kLeastBlocks) return;
  try {
    const stats::TTest test =
        sides.paired ? stats::pairedTTest(first, second) : stats::welchTTest(first, second);
    row.p = test.p_value;
    row.log10_p = test.log10_p;
  } catch (const base::InputError&) {  // no spread: there is nothing to test
  }
}

/// Selects the k-th smallest value in the range from `from` on; no value before `from` is larger.
double kth(std::vector<double>& values, std::size_t from, std::size_t k) {
  std::nth_element(values.begin() + static_cast<std::ptrdiff_t>(from),
                   values.begin() + static_cast<std::ptrdiff_t>(k), values.end());
  return values[k];
}

/// Quantile of type 7, as stats::quantile, by selection. Calls must have increasing shares; `from` advances.
double selectedQuantile(std::vector<double>& values, std::size_t& from, double share) {
  const double h = static_cast<double>(values.size() - 1) * share;
  const auto below = static_cast<std::size_t>(h);
  const double low = kth(values, from, below);
  from = below;
  if (below + 1 == values.size()) return low;
  const double high =
      *std::min_element(values.begin() + static_cast<std::ptrdiff_t>(below) + 1, values.end());
  return low + (h - static_cast<double>(below)) * (high - low);
}

stats::Statistic statisticOf(Measure measure, std::vector<double>& room, const std::function<void()>& tick) {
  switch (measure) {
    case Measure::kRms:
      return [&tick](std::span<const double> values) {
        tick();
        double sum = 0.0;
        for (const double x : values) sum += x * x;
        return std::sqrt(sum / static_cast<double>(values.size()));
      };
    case Measure::kMean:
      return [&tick](std::span<const double> values) {
        tick();
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
      };
    case Measure::kMedian:
      return [&room, &tick](std::span<const double> values) {
        tick();
        room.assign(values.begin(), values.end());
        std::size_t from = 0;
        return selectedQuantile(room, from, 0.5);
      };
    case Measure::kInterquartileRange:
      break;
  }
  return [&room, &tick](std::span<const double> values) {
    tick();
    room.assign(values.begin(), values.end());
    std::size_t from = 0;
    const double low = selectedQuantile(room, from, 0.25);
    return selectedQuantile(room, from, 0.75) - low;
  };
}

void addIntervalsTo(AnalysisRow& row, const Sides& sides, const AnalysisOptions& options,
                    const std::function<void()>& tick) {
  row.paired = sides.paired;
  row.common = sides.common;
  const auto &first = sides.first.value, &second = sides.second.value;
  row.block_length =
      std::min({std::max(lengthFor(sides.first), lengthFor(sides.second)), first.size(), second.size()});
  const stats::BootstrapOptions bootstrap{.block_length = row.block_length,
                                          .resamples = options.resamples,
                                          .pieces = sides.second.pieces,
                                          .second_pieces = sides.first.pieces};
  std::vector<double> room;
  for (std::size_t i = 0; i < kMeasures.size(); ++i) {
    base::Random random(options.seed, "analysis");
    const auto statistic = statisticOf(kMeasures[i], room, tick);
    const auto report = sides.paired
                            ? stats::bootstrapPairedDifference(second, first, statistic, bootstrap, random)
                            : stats::bootstrapDifference(second, first, statistic, bootstrap, random);
    row.difference[i].low = report.interval.low;
    row.difference[i].high = report.interval.high;
  }
  addProbability(row, sides);
}

}  // namespace

bool addIntervals(Analysis& analysis, const ErrorRun& a, const ErrorRun* b, base::Progress& progress) {
  std::vector<AnalysisRow> rows = analysis.rows;
  const auto wanted = std::count_if(rows.begin(), rows.end(), [](const AnalysisRow& row) {
    return std::isfinite(row.of(Measure::kRms).value);
  });
  const double all = static_cast<double>(wanted) * kMeasures.size() * 2.0 *
                     static_cast<double>(analysis.options.resamples + 1);
  double done = 0.0;
  const std::function<void()> tick = [&] {
    if (progress.cancelled()) throw Cancelled();
    progress.report(std::min(1.0, ++done / all), "intervals");
  };
  try {
    for (AnalysisRow& row : rows)
      if (std::isfinite(row.of(Measure::kRms).value))
        addIntervalsTo(row, sidesOf(row, a, b, analysis.options, analysis.same_motion), analysis.options,
                       tick);
  } catch (const Cancelled&) {
    return false;
  }
  analysis.rows = std::move(rows);
  analysis.intervals = true;
  return true;
}

}  // namespace capstan::analysis
