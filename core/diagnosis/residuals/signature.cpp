#include "core/diagnosis/residuals/signature.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/diagnosis/residuals/block_table.h"

namespace capstan::diagnosis {
namespace {

constexpr std::size_t kForEdges = 5000;  // samples that the edges of bins are computed from

std::vector<double> equallyWide(double low, double high, std::size_t bins) {
  std::vector<double> edges;
  for (std::size_t b = 0; b <= bins; ++b)
    edges.push_back(low + (high - low) * static_cast<double>(b) / static_cast<double>(bins));
  return edges;
}

/// Edges half way between equal width and equal filling: equal steps of the mean of (x − low) / (high − low)
/// and the share of samples below x.
std::vector<double> balanced(const std::vector<double>& values, std::size_t bins) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = *least, high = *most;
  if (!(low < high)) return {low, low + 1.0};
  std::vector<double> some;
  const std::size_t stride = std::max<std::size_t>(1, values.size() / kForEdges);
  for (std::size_t i = 0; i < values.size(); i += stride) some.push_back(values[i]);
  std::sort(some.begin(), some.end());
  std::vector<double> edges{low};
  double x = low, reached = 0.0;
  for (std::size_t i = 0; i <= some.size(); ++i) {
    const double next = i < some.size() ? some[i] : high;
    const double share = 0.5 * (next - low) / (high - low) +
                         0.5 * std::min(1.0, static_cast<double>(i + 1) / static_cast<double>(some.size()));
    for (double due; (due = static_cast<double>(edges.size()) / static_cast<double>(bins)) < 1.0 - 1e-9 &&
                     due <= share;) {
      const double part = share > reached ? (due - reached) / (share - reached) : 1.0;
      edges.push_back(x + part * (next - x));
    }
    x = next, reached = share;
  }
  edges.push_back(high);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<double> edgesOf(const Variable& variable, const std::vector<double>& values, std::size_t bins) {
  if (variable.kind == VariableKind::kDirection) return {-1.5, -0.5, 0.5, 1.5};
  if (variable.period > 0.0) return equallyWide(0.0, variable.period, bins);
  if (variable.kind == VariableKind::kTime) {
    const double low = values.front(), high = values.back();
    return equallyWide(low, high > low ? high : low + 1.0, bins);
  }
  return balanced(values, bins);
}

/// Segment of the recording in which each block begins.
std::vector<std::size_t> segmentsOf(const Channel& channel, const TimeBlocks& blocks) {
  const double span = channel.t.back() - channel.t.front();
  const double length = std::max(blocks.length, span / kSegments);
  std::vector<std::size_t> segment;
  for (const double begin : blocks.begin)
    segment.push_back(length > 0.0 ? static_cast<std::size_t>((begin - channel.t.front()) / length + 1e-9)
                                   : 0);
  return segment;
}

std::vector<bool> halves(const std::vector<std::size_t>& segment) {
  std::vector<bool> half;
  for (const std::size_t s : segment) half.push_back(s % 2 == 1);
  return half;
}

std::vector<SignatureBin> binsOf(const BlockTable& table, const std::vector<double>& edges) {
  const std::vector<BinMean> means = binMeans(table, std::vector<bool>(table.blocks(), true));
  std::vector<SignatureBin> bins;
  for (std::size_t b = 0; b < means.size(); ++b) {
    const BinMean& mean = means[b];
    if (mean.all.n == 0.0) continue;
    SignatureBin bin{edges[b], edges[b + 1], mean.all.variable / mean.all.n, mean.mean, {}, 0, mean.worth};
    bin.samples = static_cast<std::size_t>(mean.all.n);
    const double freedom = std::max(1.0, mean.worth - 1.0);
    const double reach =
        boost::math::quantile(boost::math::students_t(freedom), 0.975) * std::sqrt(mean.variance());
    bin.interval = {mean.mean - reach, mean.mean + reach};
    bins.push_back(bin);
  }
  return bins;
}

}  // namespace

Signature signatureOf(const Channel& channel, const TimeBlocks& blocks, const Variable& variable) {
  Signature signature;
  signature.kind = variable.kind;
  signature.joint = variable.joint;
  signature.variable = variable.name;
  signature.unit = variable.unit;
  signature.period = variable.period;
  signature.channel = channel.name;
  if (channel.size() == 0) return signature;
  const std::vector<double> values = variable.at(channel);
  const std::vector<double> edges = edgesOf(variable, values, kMostBins);
  const BlockTable table(channel.residual, values, blocks, edges);
  signature.bins = binsOf(table, edges);
  const std::vector<std::size_t> segment = segmentsOf(channel, blocks);
  const std::vector<bool> half = halves(segment);
  CrossValidated scored;
  if (variable.kind == VariableKind::kTime) {
    const std::size_t pairs = std::max<std::size_t>(1, (segment.back() + 1) / 2);
    const std::vector<double> coarse = edgesOf(variable, values, std::min(pairs, kMostBins));
    scored = crossValidatedShare(BlockTable(channel.residual, values, blocks, coarse), half, segment);
  } else {
    scored = crossValidatedShare(table, half, segment);
  }
  signature.share = scored.share;
  signature.share_sigma = scored.sigma;
  return signature;
}

std::vector<Signature> signaturesOf(const Channel& channel, const std::vector<Variable>& variables) {
  const TimeBlocks blocks = timeBlocks(channel);
  std::vector<Signature> signatures;
  for (const Variable& variable : variables)
    if (concerns(variable, channel)) signatures.push_back(signatureOf(channel, blocks, variable));
  return signatures;
}

}  // namespace capstan::diagnosis
