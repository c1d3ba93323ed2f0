#include "core/diagnosis/selection/gains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace capstan::diagnosis {
namespace {

constexpr int kIntervalDraws = 1000;

stats::Interval middle95(std::vector<double>& draws) {
  std::sort(draws.begin(), draws.end());
  const auto at = [&](double p) {
    return draws[static_cast<std::size_t>(p * static_cast<double>(draws.size() - 1))];
  };
  return {at(0.025), at(0.975)};
}

}  // namespace

Gain gainOf(const FitData& data, const BlockSquares& before, const BlockSquares& after, int c) {
  return gainOf(data.channels()[static_cast<std::size_t>(c)], before, after, c);
}

Gain gainOf(const ComparedChannel& channel, const BlockSquares& before, const BlockSquares& after, int c) {
  Gain gain;
  gain.channel = channel.name;
  gain.unit = channel.unit;
  std::vector<std::array<double, 3>> blocks;  // squares before and after, and how many
  for (Eigen::Index b = 0; b < before.sum.cols(); ++b)
    if (before.count(c, b) > 0.0) blocks.push_back({before.sum(c, b), after.sum(c, b), before.count(c, b)});
  if (blocks.empty()) return gain;
  const auto rms = [](const std::array<double, 3>& total, int k) {
    return std::sqrt(total[static_cast<std::size_t>(k)] / total[2]);
  };
  std::array<double, 3> all{};
  for (const auto& block : blocks)
    for (std::size_t k = 0; k < 3; ++k) all[k] += block[k];
  gain.rms_before = rms(all, 0);
  gain.rms_after = rms(all, 1);
  base::Random random(1, "gain");
  std::vector<double> befores, afters, ratios;
  for (int d = 0; d < kIntervalDraws; ++d) {
    std::array<double, 3> total{};
    for (std::size_t n = 0; n < blocks.size(); ++n) {
      const auto& block = blocks[random.bits() % blocks.size()];
      for (std::size_t k = 0; k < 3; ++k) total[k] += block[k];
    }
    befores.push_back(rms(total, 0));
    afters.push_back(rms(total, 1));
    ratios.push_back(afters.back() / std::max(befores.back(), 1e-300));
  }
  gain.before = middle95(befores);
  gain.after = middle95(afters);
  gain.interval = middle95(ratios);
  return gain;
}

}  // namespace capstan::diagnosis
