#include "core/diagnosis/fit/simulation_inputs.h"

#include <algorithm>

#include "core/diagnosis/evidence/smooth_readings.h"
#include "core/diagnosis/fit/chain_simulation.h"

namespace capstan::diagnosis {
namespace {

/// Noise of one joint's channel; zero if none was estimated.
ChannelNoise noiseOf(const std::vector<ChannelNoise>& noise, std::size_t joint) {
  return joint < noise.size() ? noise[joint] : ChannelNoise{};
}

/// Column without its sensor's noise, smoothed segment by segment.
std::vector<double> smooth(const Evidence& evidence, std::vector<double> column, const ChannelNoise& noise) {
  for (const Segment& segment : evidence.segments) {
    const auto readings = std::span(column).subspan(segment.begin, segment.size());
    std::ranges::copy(smoothReadings(readings, noise.floor()), readings.begin());
  }
  return column;
}

}  // namespace

robot::ChainRows SimulationInputs::rows(const std::vector<double>& t) const {
  robot::ChainRows rows;
  rows.t = t.data();
  for (std::size_t j = 0; j < drive.size(); ++j) rows.drive[j] = drive[j].data();
  for (std::size_t j = 0; j < load.size(); ++j) {
    rows.load[j] = load[j].data();
    rows.signed_load[j] = signed_load[j].data();
  }
  return rows;
}

SimulationInputs inputsOf(const Evidence& evidence) {
  const EvidenceNoise& noise = evidence.noise;
  const bool cable = evidence.drive == DriveKind::kCable;
  SimulationInputs inputs;
  if (!cable) inputs.drive = evidence.tau_m;
  for (std::size_t j = 0; cable && j < evidence.q_m.size(); ++j)  // encoder steps would jerk the cable
    inputs.drive.push_back(smooth(evidence, evidence.q_m[j], noiseOf(noise.q_m, j)));
  for (std::size_t j = 0; j < evidence.tau_ext.size(); ++j) {
    const ChannelNoise of = noiseOf(noise.tau_ext, j);
    inputs.load.push_back(smooth(evidence, evidence.tau_ext[j], of));
    inputs.signed_load.push_back(smooth(evidence, withSigns(evidence.tau_ext[j]), of));
  }
  return inputs;
}

SimulationInputs shakenInputs(const Evidence& evidence, const SimulationInputs& inputs,
                              base::Random& random) {
  const EvidenceNoise& noise = evidence.noise;
  const auto shake = [&](std::vector<double>& column, const ChannelNoise& of) {
    for (double& x : column) x += random.normal(0.0, of.floor());
    column = smooth(evidence, std::move(column), of);
  };
  SimulationInputs shaken = inputs;
  for (std::size_t j = 0; j < inputs.drive.size(); ++j) {
    if (evidence.drive == DriveKind::kCable) shake(shaken.drive[j], noiseOf(noise.q_m, j));
    if (j >= inputs.load.size()) continue;
    shake(shaken.load[j], noiseOf(noise.tau_ext, j));
    shake(shaken.signed_load[j], noiseOf(noise.tau_ext, j));
  }
  return shaken;
}

SimulationInputs withTorqueNoise(const Evidence& evidence, const SimulationInputs& inputs,
                                 base::Random& random) {
  SimulationInputs noisy = inputs;
  if (evidence.drive == DriveKind::kCable) return noisy;
  for (std::size_t j = 0; j < noisy.drive.size(); ++j)
    for (double& x : noisy.drive[j]) x += random.normal(0.0, noiseOf(evidence.noise.tau_m, j).floor());
  return noisy;
}

}  // namespace capstan::diagnosis
