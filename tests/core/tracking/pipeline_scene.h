#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/simulation/simulated_source.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"
#include "tests/support/folders.h"

namespace capstan::tracking::test {

inline const std::string kResources = capstan::test::sourceFile("resources");

inline simulation::SimulatedOptions simulated(const simulation::Truth& truth, double duration, bool images) {
  simulation::SimulatedOptions options;
  options.robot = robot::readDescription(kResources + "/robots/raven2_left.yaml");
  options.truth = truth;
  options.trajectory.kind = simulation::TrajectoryKind::kSinusoid;
  options.trajectory.duration = duration;
  options.rig = vision::readStereoRig(kResources + "/cameras/left.yaml", kResources + "/cameras/right.yaml");
  options.images = images;
  options.seed = 5;
  return options;
}

/// All samples of a source without images.
inline std::vector<Sample> samplesOf(tracking::Source& source) {
  std::vector<Sample> samples;
  for (Sample sample; source.next(sample);) samples.push_back(sample);
  return samples;
}

/// A recording of measured data, where it is at hand: $CAPSTAN_DATA or ../shared/data beside the repository.
inline std::optional<std::filesystem::path> measured(const std::string& file) {
  const std::filesystem::path path = capstan::test::dataFolder() / file;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  return path;
}

/// Samples from memory.
class ListSource {
 public:
  explicit ListSource(std::vector<Sample> samples) : samples_(std::move(samples)) {}
  bool next(Sample& out) {
    if (at_ == samples_.size()) return false;
    out = samples_[at_++];
    return true;
  }

 private:
  std::vector<Sample> samples_;
  std::size_t at_ = 0;
};

}  // namespace capstan::tracking::test
