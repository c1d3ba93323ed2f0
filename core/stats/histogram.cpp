#include "core/stats/histogram.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/base/error.h"
#include "core/stats/quantile.h"
#include "core/stats/samples.h"

namespace capstan::stats {
namespace {

std::vector<double> equalEdges(double low, double high, std::size_t bins) {
  if (bins == 0) throw base::InputError({{}, 0, "bins", "0", "a histogram needs a bin", "Ask for 1 or more"});
  const std::string range = fmt::format("{} to {}", low, high);
  if (!(low < high) || !std::isfinite(high - low))
    throw base::InputError(
        {{}, 0, "range", range, "must be finite and ascending", "Give a low end below the high"});
  std::vector<double> edges(bins + 1);
  const auto count = static_cast<double>(bins);
  for (std::size_t k = 0; k < bins; ++k) edges[k] = low + (high - low) * (static_cast<double>(k) / count);
  edges[bins] = high;
  if (std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<>()) != edges.end())
    throw base::InputError({{},
                            0,
                            "range",
                            range,
                            fmt::format("is too narrow for {} bins in double precision", bins),
                            "Ask for fewer bins or a wider range"});
  return edges;
}

/// Index of the bin of x, x in [edges.front(), edges.back()]: first by division, then corrected by the edges.
std::size_t binOf(double x, const std::vector<double>& edges) {
  const std::size_t last = edges.size() - 2;
  const double share = (x - edges.front()) / (edges.back() - edges.front());
  auto bin = std::min(last, static_cast<std::size_t>(share * static_cast<double>(last + 1)));
  while (bin > 0 && x < edges[bin]) --bin;
  while (bin < last && x >= edges[bin + 1]) ++bin;
  return bin;
}

/// Largest number of bins over [low, high] whose edges differ in double precision.
double distinctBins(double low, double high) {
  const double step = std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high));
  return std::max(1.0, std::floor((high - low) / (2.0 * step)));
}

double freedmanDiaconisBins(std::span<const double> values, double range) {
  const double shares[] = {0.25, 0.75};
  const std::vector<double> quartiles = quantiles(values, shares);
  const auto n = static_cast<double>(values.size());
  const double width = 2.0 * (quartiles[1] - quartiles[0]) / std::cbrt(n);
  return width > 0.0 ? std::ceil(range / width) : std::ceil(std::log2(n)) + 1.0;
}

}  // namespace

std::uint64_t Histogram::total() const {
  return std::accumulate(counts.begin(), counts.end(), underflow + overflow);
}

double Histogram::binWidth() const {
  return (edges.back() - edges.front()) / static_cast<double>(counts.size());
}

std::vector<double> Histogram::density() const {
  std::vector<double> result(counts.size(), 0.0);
  const auto all = static_cast<double>(total());
  if (all == 0.0) return result;
  for (std::size_t k = 0; k < counts.size(); ++k)
    result[k] = static_cast<double>(counts[k]) / all / binWidth();
  return result;
}

Histogram histogram(std::span<const double> values, double low, double high, std::size_t bins) {
  Histogram result{equalEdges(low, high, bins), std::vector<std::uint64_t>(bins, 0)};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = values[i];
    if (std::isnan(x)) refuseSample(values, i, "histogram");
    if (x < low) {
      ++result.underflow;
    } else if (x > high) {
      ++result.overflow;
    } else {
      ++result.counts[binOf(x, result.edges)];
    }
  }
  return result;
}

Histogram histogramFreedmanDiaconis(std::span<const double> values, std::size_t most) {
  requireSamples(values, 1, "histogram");
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high) {
    const double half = *low == 0.0 ? 0.5 : std::abs(*low) / 2.0;
    return histogram(values, *low - half, *low + half, 1);
  }
  if (!std::isfinite(*high - *low)) return histogram(values, *low, *high, 1);  // throws
  const double bins =
      std::min({freedmanDiaconisBins(values, *high - *low),
                static_cast<double>(std::max<std::size_t>(most, 1)), distinctBins(*low, *high)});
  return histogram(values, *low, *high, static_cast<std::size_t>(bins));
}

}  // namespace capstan::stats
