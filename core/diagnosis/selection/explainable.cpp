#include "core/diagnosis/selection/explainable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/nan.h"
#include "core/base/parallel.h"
#include "core/base/progress_share.h"
#include "core/diagnosis/residuals/process_parts.h"
#include "core/diagnosis/selection/verdict.h"

namespace capstan::diagnosis {
namespace {

/// Channels of all recordings that read the same thing.
struct Group {
  ComparedChannel channel;
  std::vector<int> members;  ///< among FitData::channels()
};

std::vector<Group> groupsOf(const FitData& data) {
  const bool encoders =
      std::ranges::any_of(data.channels(), [](const ComparedChannel& c) { return c.joint > 0; });
  std::vector<Group> groups;
  for (std::size_t c = 0; c < data.channels().size(); ++c) {
    const ComparedChannel& channel = data.channels()[c];
    if (encoders && channel.joint == 0) continue;
    const auto same = std::ranges::find_if(groups, [&](const Group& group) {
      return group.channel.joint == channel.joint && group.channel.axis == channel.axis;
    });
    (same == groups.end() ? groups.emplace_back(Group{channel, {}}) : *same)
        .members.push_back(static_cast<int>(c));
  }
  return groups;
}

double meanSquareOf(const BlockSquares& squares, const Group& group) {
  double sum = 0.0, count = 0.0;
  for (const int c : group.members) sum += squares.sum.row(c).sum(), count += squares.count.row(c).sum();
  return count > 0.0 ? sum / count : 0.0;
}

/// Residual of the refitted nominal structure and what it may depend on, the recordings one after another.
struct Pooled {
  Channel channel;
  std::vector<Variable> variables;
};

void append(std::vector<Variable>& all, std::vector<Variable> more) {
  if (all.empty()) {
    all = std::move(more);
    return;
  }
  std::erase_if(all, [&](const Variable& one) {
    return std::ranges::none_of(more, [&](const Variable& other) { return other.name == one.name; });
  });
  for (Variable& one : all) {
    const auto same = std::ranges::find(more, one.name, &Variable::name);
    one.values.insert(one.values.end(), same->values.begin(), same->values.end());
  }
}

Pooled pooledOf(const FitData& data, const Selection& s, const robot::Description& nominal,
                const Group& group) {
  constexpr double kBetween = 10.0;  // between recordings [s]: nothing lasts from one to the next
  Pooled pooled;
  Channel& channel = pooled.channel;
  channel.name = group.channel.name, channel.unit = group.channel.unit;
  channel.joint = group.channel.joint, channel.axis = group.channel.axis, channel.noise = group.channel.noise;
  const robot::ChainModel model = s.base.model.chain(s.base.u);
  double begin = 0.0, rows = 0.0;
  for (int r = 0; r < data.recordings(); ++r) {
    const ChainSimulation& simulation = data.simulation(r);
    const Evidence& evidence = simulation.evidence();
    append(pooled.variables, variablesOf(evidence, simulation.motion(model), nominal));
    const Compared& compared = simulation.compared();
    for (std::size_t i = 0; i < compared.t.size(); ++i) {
      const Eigen::Index at = data.first(r) + static_cast<Eigen::Index>(i);
      if (!std::ranges::count(group.members, data.channel()[static_cast<std::size_t>(at)])) continue;
      const auto after = std::ranges::lower_bound(evidence.t, compared.t[i]);
      const auto row = std::min<std::ptrdiff_t>(after - evidence.t.begin(),
                                                static_cast<std::ptrdiff_t>(evidence.rows()) - 1);
      channel.t.push_back(begin + compared.t[i] - evidence.t.front());
      channel.row.push_back(rows + static_cast<double>(row));
      channel.residual.push_back(s.base.e[at]);
      channel.measured.push_back(data.measured()[at]);
      channel.simulated.push_back(data.measured()[at] - s.base.e[at]);
    }
    begin += evidence.t.back() - evidence.t.front() + kBetween;
    rows += static_cast<double>(evidence.rows());
  }
  channel.period = channel.t.size() > 1 ? channel.t[1] - channel.t[0] : 0.0;
  std::erase_if(pooled.variables, [&](const Variable& v) { return !concerns(v, channel); });
  return pooled;
}

Explainable explainableOf(const FitData& data, const Selection& s, const robot::Description& nominal,
                          const Group& group, const base::Progress* progress,
                          const std::function<void()>& part) {
  const MeasuredRegression linear = group.channel.joint > 0 ? measuredRegression(data, group.channel.joint)
                                                            : MeasuredRegression{base::kNaN, {}};
  const Pooled pooled = pooledOf(data, s, nominal, group);
  Channel channel = pooled.channel;
  channel.noise = std::hypot(group.channel.noise, s.input_noise.rms[group.members.front()]);
  const double refitted = meanSquareOf(s.base_squares, group);
  return explainableFrom(
      channel, refitted, meanSquareOf(s.best_squares, group), linear, refitted,
      residualProcessInParts(pooled.channel, pooled.variables, {.shuffles = 2}, progress, part));
}

double beyondNoise(const Group& group, const Selection& s) {
  const double noise = std::max(group.channel.noise, 1e-12);
  return meanSquareOf(s.base_squares, group) / (noise * noise);
}

}  // namespace

Explainable explainableFrom(const Channel& channel, double refitted, double named,
                            const MeasuredRegression& linear, double process_mean_square,
                            const ResidualProcess& process) {
  Explainable one{channel.name,        channel.unit,     channel.noise,
                  std::sqrt(refitted), std::sqrt(named), std::sqrt(linear.mean_square),
                  base::kNaN,          base::kNaN,       {}};
  double least = refitted;
  if (linear.mean_square < least) {
    least = linear.mean_square;
    one.leans_on = fmt::format("depends on {}", fmt::join(linear.columns, ", "));
  }
  if (process.end == ProcessEnd::kDone) {
    const double flexible = process_mean_square * std::clamp(1.0 - process.explained, 0.0, 1.0);
    one.flexible = std::sqrt(flexible);
    if (flexible < least) least = flexible, one.leans_on = process.words;
  }
  if (least < refitted) one.share = std::min(1.0, (refitted - named) / (refitted - least));
  return one;
}

std::vector<Explainable> explainableOf(const FitData& data, const Selection& s,
                                       const robot::Description& nominal, base::Progress* progress) {
  std::vector<Group> groups = groupsOf(data);
  std::ranges::stable_sort(groups, std::greater<>(),
                           [&](const Group& group) { return beyondNoise(group, s); });
  base::ProgressShare share(progress, kExplainableEnd, "Fitting a regression to the residual",
                            groups.size() * kProcessParts);
  std::vector<Explainable> channels(groups.size());
  base::parallelFor(groups.size(), data.threads(), [&](std::size_t k) {
    channels[k] = explainableOf(data, s, nominal, groups[k], progress, [&share] { share.finished(); });
  });
  return channels;
}

bool fallsShort(const std::vector<Explainable>& channels, const Tolerance& tolerance) {
  return std::ranges::any_of(channels, [&](const Explainable& one) {
    const double most = one.unit == "rad" ? tolerance.angle : tolerance.length;
    const double least = std::fmin(one.linear, one.flexible);
    return one.share < kNear && one.named > kBeyondNoise * one.noise &&
           one.named * one.named > least * least + most * most;
  });
}

bool isAllThatCanBe(const std::vector<Explainable>& channels) {
  bool any = false;
  for (const Explainable& one : channels) {
    if (one.share < kNear && one.named > kBeyondNoise * one.noise) return false;
    any = any || one.share >= kNear;
  }
  return any;
}

}  // namespace capstan::diagnosis
