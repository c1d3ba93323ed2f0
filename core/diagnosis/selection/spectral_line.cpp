#include "core/diagnosis/selection/spectral_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace capstan::diagnosis {
namespace {

constexpr std::size_t kFewest = 200;
constexpr std::size_t kMost = 6000;      // samples that go in
constexpr std::size_t kNeighbours = 40;  // frequencies on either side that say how high the noise is

struct Thinned {
  std::vector<double> t, e;
};

Thinned thinned(const Channel& channel) {
  const std::size_t stride = std::max<std::size_t>(1, channel.size() / kMost);
  Thinned kept;
  double mean = 0.0;
  for (const double e : channel.residual) mean += e / static_cast<double>(channel.size());
  const double begin = channel.t.front(), span = channel.t.back() - begin;
  for (std::size_t k = 0; k < channel.size(); k += stride) {
    const double window = std::sin(std::numbers::pi * (channel.t[k] - begin) / span);  // Hann
    kept.t.push_back(channel.t[k] - begin);
    kept.e.push_back((channel.residual[k] - mean) * window * window);
  }
  return kept;
}

double powerAt(const Thinned& x, double frequency) {
  double c = 0.0, s = 0.0;
  for (std::size_t k = 0; k < x.t.size(); ++k) {
    const double phase = 2.0 * std::numbers::pi * frequency * x.t[k];
    c += x.e[k] * std::cos(phase), s += x.e[k] * std::sin(phase);
  }
  return c * c + s * s;
}

/// Mean of exponential noise from the median of what is around.
double levelAround(const std::vector<double>& power, std::size_t k) {
  const std::size_t begin = k > kNeighbours ? k - kNeighbours : 0,
                    end = std::min(power.size(), k + kNeighbours + 1);
  std::vector<double> near(power.begin() + static_cast<std::ptrdiff_t>(begin),
                           power.begin() + static_cast<std::ptrdiff_t>(end));
  const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
  std::nth_element(near.begin(), middle, near.end());
  return *middle / std::numbers::ln2;
}

}  // namespace

std::optional<SpectralLine> spectralLine(const Channel& channel) {
  if (channel.size() < kFewest) return std::nullopt;
  const double span = channel.t.back() - channel.t.front();
  const Thinned x = thinned(channel);
  const double nyquist = 0.5 * static_cast<double>(x.t.size()) / span;
  const double highest = std::min(kHighestLine, 0.9 * nyquist), step = 1.0 / span;
  if (highest < kLowestLine + 2.0 * kNeighbours * step) return std::nullopt;
  std::vector<double> power;
  for (double f = kLowestLine; f < highest; f += step) power.push_back(powerAt(x, f));
  std::size_t line = 0;
  double ratio = 0.0;
  for (std::size_t k = 0; k < power.size(); ++k)
    if (const double level = levelAround(power, k); level > 0.0 && power[k] / level > ratio)
      ratio = power[k] / level, line = k;
  const double p = 1.0 - std::pow(1.0 - std::exp(-ratio), static_cast<double>(power.size()));
  if (!(p < kLineChance)) return std::nullopt;
  const double sum_of_window = 0.5 * static_cast<double>(x.t.size());
  return SpectralLine{channel.name, kLowestLine + static_cast<double>(line) * step,
                      2.0 * std::sqrt(power[line]) / sum_of_window, p};
}

}  // namespace capstan::diagnosis
