#include "core/diagnosis/residuals/residual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/diagnosis/residuals/decimated_residual.h"
#include "core/stats/quantile.h"
#include "core/stats/rms.h"

namespace capstan::diagnosis {
namespace {

constexpr std::size_t kMostLags = 20;

[[noreturn]] void refuse(const Evidence& evidence, std::string key, std::string value, std::string reason,
                         std::string remedy) {
  throw base::InputError(
      {evidence.file, 0, std::move(key), std::move(value), std::move(reason), std::move(remedy)});
}

void checkShape(const Evidence& evidence, const SimulatedMotion& simulated, const robot::Description& robot) {
  const auto n = static_cast<std::size_t>(evidence.joints);
  const char* remedy = "Simulate the recording that the residual is of";
  if (simulated.q.size() != n || robot.joints.size() != n)
    refuse(evidence, "simulated q", fmt::format("{} joints", simulated.q.size()),
           fmt::format("but the recording has {}, the robot file {}", n, robot.joints.size()), remedy);
  for (const Columns* columns :
       {&simulated.q, &simulated.dq, &simulated.ddq, &simulated.tau, &simulated.stretch})
    for (const std::vector<double>& column : *columns)
      if (column.size() != evidence.rows())
        refuse(evidence, "simulated", fmt::format("{} rows", column.size()),
               fmt::format("but the recording has {}", evidence.rows()), remedy);
  if (evidence.hasCameras() && simulated.tip.size() != evidence.tip.size())
    refuse(evidence, "simulated tip", fmt::format("{} observations", simulated.tip.size()),
           fmt::format("but the recording has {}", evidence.tip.size()), remedy);
}

void push(const Evidence& evidence, Channel& channel, double t, double row, double measured,
          double simulated) {
  if (!std::isfinite(simulated))
    refuse(evidence, "simulated " + channel.name, fmt::format("{} at {:.3f} s", simulated, t),
           "is not finite: the simulation diverged",
           "Start from a robot file whose parameters are nearer to this robot");
  channel.t.push_back(t);
  channel.row.push_back(row);
  channel.measured.push_back(measured);
  channel.simulated.push_back(simulated);
  channel.residual.push_back(measured - simulated);
}

Channel jointChannel(const Evidence& evidence, const std::vector<double>& simulated, std::size_t j,
                     bool turns) {
  Channel channel;
  channel.name = fmt::format("q{}", j + 1);
  channel.unit = turns ? "rad" : "m";
  channel.joint = static_cast<int>(j) + 1;
  if (j < evidence.noise.q.size()) channel.noise = evidence.noise.q[j].floor();
  for (std::size_t row = 0; row < evidence.rows(); ++row)
    if (evidence.counts(row) && std::isfinite(evidence.q[j][row]))
      push(evidence, channel, evidence.t[row], static_cast<double>(row), evidence.q[j][row], simulated[row]);
  return channel;
}

Channel tipChannel(const Evidence& evidence, const std::vector<Eigen::Vector3d>& simulated, int axis) {
  Channel channel;
  channel.name = fmt::format("tip {}", "xyz"[axis]);
  channel.unit = "m";
  channel.axis = axis;
  channel.noise = evidence.noise.tip[static_cast<std::size_t>(axis)].floor();
  for (std::size_t i = 0; i < evidence.tip.size(); ++i) {
    const TipObservation& observation = evidence.tip[i];
    if (observation.counts)
      push(evidence, channel, observation.t, observation.row, observation.position(axis), simulated[i](axis));
  }
  return channel;
}

void setPeriod(Channel& channel) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < channel.size(); ++i) periods.push_back(channel.t[i] - channel.t[i - 1]);
  channel.period = periods.empty() ? 0.0 : stats::median(periods);
}

bool varies(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low < *high;
}

}  // namespace

std::vector<Channel> residualOf(const Evidence& evidence, const SimulatedMotion& simulated,
                                const robot::Description& robot) {
  checkShape(evidence, simulated, robot);
  std::vector<Channel> channels;
  for (std::size_t j = 0; j < evidence.q.size(); ++j)
    channels.push_back(
        jointChannel(evidence, simulated.q[j], j, robot.joints[j].type == robot::JointType::kRevolute));
  for (int axis = 0; axis < 3 && evidence.hasCameras(); ++axis)
    channels.push_back(tipChannel(evidence, simulated.tip, axis));
  std::erase_if(channels, [](const Channel& channel) { return channel.size() == 0; });
  for (Channel& channel : channels) setPeriod(channel);
  return channels;
}

ChannelStatistics statisticsOf(const Channel& channel) {
  ChannelStatistics result;
  result.name = channel.name;
  result.unit = channel.unit;
  result.samples = channel.size();
  result.rms = stats::rms(channel.residual);
  result.mean = stats::mean(channel.residual);
  double swing = 0.0;
  const double centre = stats::mean(channel.measured);
  for (const double y : channel.measured) swing += (y - centre) * (y - centre);
  const auto n = static_cast<double>(channel.size());
  result.fit = swing > 0.0 ? 100.0 * (1.0 - result.rms * std::sqrt(n / swing))
                           : std::numeric_limits<double>::quiet_NaN();
  result.noise = channel.noise;
  if (result.rms > 0.0)
    result.beyond_noise = std::max(0.0, 1.0 - channel.noise * channel.noise / (result.rms * result.rms));
  const Decimated thin = decimate(channel, kForCorrelation);
  result.whiteness_period = thin.period;
  if (thin.residual.size() >= kFewestForWhiteness && varies(thin.residual))
    result.whiteness = stats::ljungBox(thin.residual, std::min(kMostLags, thin.residual.size() / 5));
  else
    result.whiteness.q = std::numeric_limits<double>::quiet_NaN();
  result.effective_samples = effectiveSamples(channel.residual, timeBlocks(channel));
  return result;
}

}  // namespace capstan::diagnosis
