#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/parallel.h"
#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

FitData::FitData(const std::vector<Evidence>& recordings, const robot::Description& robot, double horizon,
                 EncoderZeros zeros, int threads, const base::Progress* progress)
    : threads_(threads), progress_(progress), zeros_(zeros) {
  if (zeros_ == EncoderZeros::kOnePerRecording && recordings.size() == 1) zeros_ = EncoderZeros::kKnown;
  for (const Evidence& evidence : recordings) {
    rigid_ = evidence.drive == DriveKind::kRigid;
    simulations_.push_back(std::make_unique<ChainSimulation>(evidence, robot, horizon));
    stack(*simulations_.back());
  }
  if (!rigid_ && zeros_ == EncoderZeros::kOneForAll) segments_.emplace_back(0, measured_.size());
}

void FitData::stack(const ChainSimulation& simulation) {
  const Compared& compared = simulation.compared();
  const Eigen::Index begin = measured_.size();
  first_.push_back(begin);
  measured_.conservativeResize(begin + compared.measured.size());
  measured_.tail(compared.measured.size()) = compared.measured;
  const int first_channel = static_cast<int>(channels_.size());
  channels_.insert(channels_.end(), compared.channels.begin(), compared.channels.end());
  for (const int channel : compared.channel) channel_.push_back(first_channel + channel);
  const bool windows_have_own = rigid_;
  for (std::size_t w = 0; w + 1 < compared.window_begin.size(); ++w) {
    const std::size_t from = compared.window_begin[w], to = compared.window_begin[w + 1];
    if (from == to) continue;
    if (windows_have_own)
      segments_.emplace_back(begin + static_cast<Eigen::Index>(from), begin + static_cast<Eigen::Index>(to));
    const auto [low, high] = std::minmax_element(compared.t.begin() + static_cast<std::ptrdiff_t>(from),
                                                 compared.t.begin() + static_cast<std::ptrdiff_t>(to));
    const double span = *high - *low;
    const bool whole = rigid_ && span < 4.0 * kBlock;
    const int pieces = whole ? 1 : std::max(1, static_cast<int>(std::lround(span / kBlock)));
    for (std::size_t i = from; i < to; ++i) {
      const double share = span > 0.0 ? (compared.t[i] - *low) / span : 0.0;
      block_.push_back(blocks_ + std::min(pieces - 1, static_cast<int>(share * pieces)));
    }
    blocks_ += pieces;
  }
  if (!windows_have_own && zeros_ == EncoderZeros::kOnePerRecording)
    segments_.emplace_back(begin, measured_.size());
}

namespace {

/// Robots of one recording that are simulated side by side, at most 16.
struct Group {
  std::size_t recording = 0;
  int steps = 1;
  std::vector<std::size_t> members;
};

/// Bits of the joints that are compliant. At each joint all or none of a group are, since no parameter value
/// turns that law off.
unsigned complianceOf(const robot::ChainModel& model) {
  unsigned bits = 0;
  for (int j = 0; j < model.shape.joints; ++j)
    if (model.shape.laws[j] & robot::kLawCompliance) bits |= 1u << j;
  return bits;
}

/// Groups of one recording: of equal compliance and equal numbers of integration steps.
void addGroups(const ChainSimulation& simulation, std::size_t recording,
               const std::vector<robot::ChainModel>& models, const std::vector<std::size_t>& family,
               std::vector<Group>& groups) {
  std::map<std::size_t, int> steps;  // of each family
  for (std::size_t k = 0; k < models.size(); ++k) {
    int& most = steps[family.empty() ? 0 : family[k]];
    most = std::max(most, simulation.stepsFor(models[k]));
  }
  std::map<std::pair<unsigned, int>, std::vector<std::size_t>> kinds;
  for (std::size_t k = 0; k < models.size(); ++k)
    kinds[{complianceOf(models[k]), steps[family.empty() ? 0 : family[k]]}].push_back(k);
  for (const auto& [kind, members] : kinds)
    for (std::size_t k = 0; k < members.size(); ++k) {
      if (k % robot::kChainLanes == 0) groups.push_back({recording, kind.second, {}});
      groups.back().members.push_back(members[k]);
    }
}

}  // namespace

Eigen::MatrixXd FitData::simulate(const std::vector<robot::ChainModel>& models,
                                  const std::vector<InitialStates>& initial,
                                  const std::vector<std::size_t>& family) const {
  Eigen::MatrixXd readings(size(), static_cast<Eigen::Index>(models.size()));
  std::vector<Group> groups;
  for (std::size_t r = 0; r < simulations_.size(); ++r)
    addGroups(*simulations_[r], r, models, family, groups);
  base::parallelFor(groups.size(), threads_, [&](std::size_t task) {
    const auto& [r, steps, members] = groups[task];
    std::vector<Robot> robots;
    for (const std::size_t k : members)
      robots.push_back({&models[k], initial.empty() ? nullptr : &initial[k][r], steps});
    const Eigen::Index rows = simulations_[r]->compared().measured.size();
    Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(members.size()));
    simulations_[r]->simulate(robots, columns);
    for (std::size_t k = 0; k < members.size(); ++k)
      readings.col(static_cast<Eigen::Index>(members[k])).segment(first_[r], rows) =
          columns.col(static_cast<Eigen::Index>(k));
  });
  return readings;
}

Eigen::VectorXd weightsFor(const FitData& data, const Eigen::VectorXd& e) {
  const std::size_t channels = data.channels().size();
  std::vector<double> squares(channels, 0.0), count(channels, 0.0);
  std::vector<std::vector<double>> sums(channels,
                                        std::vector<double>(static_cast<std::size_t>(data.blocks()), 0.0));
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    const auto c = static_cast<std::size_t>(data.channel()[i]);
    const double x = e[static_cast<Eigen::Index>(i)];
    squares[c] += x * x, count[c] += 1.0;
    sums[c][static_cast<std::size_t>(data.block()[i])] += x;
  }
  const auto noiseOf = [&](std::size_t c) { return std::max(data.channels()[c].noise, 1e-12); };
  double worst = 1.0;  // largest ratio RMS / noise of all channels
  for (std::size_t c = 0; c < channels; ++c)
    if (count[c] > 0.0) worst = std::max(worst, std::sqrt(squares[c] / count[c]) / noiseOf(c));
  std::vector<double> weight(channels, 0.0);
  for (std::size_t c = 0; c < channels; ++c) {
    if (count[c] < 1.0) continue;
    const double rms = std::sqrt(squares[c] / count[c]);
    const double scale = std::max(rms, noiseOf(c) * std::sqrt(worst));
    double between = 0.0;
    for (const double sum : sums[c]) between += sum * sum;
    const double inflation =
        squares[c] > 0.0 ? std::clamp(between / squares[c], 1.0, count[c] / 10.0 + 1.0) : 1.0;
    weight[c] = 1.0 / (scale * std::sqrt(inflation));
  }
  Eigen::VectorXd weights(data.size());
  for (std::size_t i = 0; i < data.channel().size(); ++i)
    weights[static_cast<Eigen::Index>(i)] = weight[static_cast<std::size_t>(data.channel()[i])];
  return weights;
}

}  // namespace capstan::diagnosis
