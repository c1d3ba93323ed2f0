/// Speed of the whole tracking pipeline as a multiple of real time, and its allocations a sample: motors
/// only, tip samples, and rendered frames with the default truth's latency (each frame replays the motor
/// samples since its exposure). Rendering is outside the measured time. Then the augmented filter beside the
/// six states of the UKF paper, sample by sample in turns, with nominal constants, so that the augmented one
/// carries an error. Names the processor.
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "core/simulation/simulated_source.h"
#include "core/simulation/simulation_request.h"
#include "core/tracking/make_pipeline.h"
#include "tests/support/counting_malloc.h"
#include "tests/support/folders.h"

namespace {

using namespace capstan;
using Clock = std::chrono::steady_clock;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

struct Case {
  const char* name;
  bool cameras, images, full_frame;
  double duration;
};

void measure(const Case& one) {
  simulation::SimulatedOptions options;
  const std::string resources = test::sourceFile("resources");
  options.robot = robot::readDescription(resources + "/robots/raven2_left.yaml");
  if (one.cameras)
    options.rig = vision::readStereoRig(resources + "/cameras/left.yaml", resources + "/cameras/right.yaml");
  options.images = one.images;
  options.trajectory.kind = simulation::TrajectoryKind::kSinusoid;
  options.trajectory.duration = one.duration;
  simulation::SimulatedSource source(options);
  tracking::SourceInfo info = source.info();
  if (one.full_frame) info.base_from_camera.reset();
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info);

  constexpr double kWarm = 1.0;
  std::chrono::duration<double> spent{}, spent_frames{};
  std::size_t allocations = 0, samples = 0, frames = 0;
  double last = 0.0;
  tracking::Sample sample;
  while (source.next(sample)) {
    const std::size_t before = test::mallocs();
    const auto begin = Clock::now();
    const tracking::Snapshot& snapshot = pipeline.step(sample);
    const auto taken = Clock::now() - begin;
    if (snapshot.t < kWarm) continue;
    allocations += test::mallocs() - before;
    spent += taken;
    ++samples;
    if (snapshot.camera_updated) {
      spent_frames += taken;
      ++frames;
    }
    last = snapshot.t;
  }
  fmt::print("{:<34}{:>10.1f}{:>14.2f}{:>16.1f}{:>16.4f}\n", one.name, (last - kWarm) / spent.count(),
             1e6 * (spent - spent_frames).count() / static_cast<double>(samples - frames),
             frames ? 1e6 * spent_frames.count() / static_cast<double>(frames) : 0.0,
             static_cast<double>(allocations) / static_cast<double>(samples));
}

/// Both filters take each sample of a block transfer in turns. Time of all samples, camera samples included.
void compareFilters(bool images, double duration) {
  simulation::SimulationRequest request;
  request.duration = duration;
  request.images = images;
  simulation::SimulatedSource source(simulation::optionsOf(request));
  tracking::TrackingPipeline six = tracking::makePipeline(source.info(), tracking::sixState());
  tracking::TrackingPipeline augmented = tracking::makePipeline(source.info(), tracking::TrackingOptions{});
  std::chrono::duration<double> spent[2] = {};
  std::size_t samples = 0, allocations = 0;
  tracking::Sample sample;
  while (source.next(sample)) {
    const auto begin = Clock::now();
    six.step(sample);
    const auto middle = Clock::now();
    const std::size_t before = test::mallocs();
    const double t = augmented.step(sample).t;
    const auto end = Clock::now();
    if (t < 1.0) continue;
    allocations += test::mallocs() - before;
    spent[0] += middle - begin;
    spent[1] += end - middle;
    ++samples;
  }
  fmt::print("{:<34}{:>14.2f}{:>14.2f}{:>10.2f}{:>16.4f}   joint 1's travel {:+.2f} %\n",
             images ? "2 × 15 frames/s" : "15 tip samples a second", 1e6 * spent[0].count() / samples,
             1e6 * spent[1].count() / samples, spent[1] / spent[0],
             static_cast<double>(allocations) / static_cast<double>(samples),
             100.0 * augmented.snapshot().transmission.scale(0));
}

}  // namespace

int main() try {
  fmt::print("{}\n{:<34}{:>10}{:>14}{:>16}{:>16}\n", processor(), "pipeline, 1 kHz motors", "× real t.",
             "us a sample", "us a camera", "allocs/sample");
  measure({"motors only", false, false, false, 21.0});
  measure({"15 tip samples a second", true, false, false, 21.0});
  measure({"2 × 15 frames/s, ROI", true, true, false, 11.0});
  measure({"2 × 15 frames/s, whole frame", true, true, true, 11.0});
  fmt::print("\n{:<34}{:>14}{:>14}{:>10}{:>16}\n", "us a sample, all samples", "six states", "augmented",
             "ratio", "allocs/sample");
  compareFilters(false, 31.0);
  compareFilters(true, 11.0);
  if (!capstan::test::countsMalloc())
    fmt::print("allocations were not counted: malloc belongs to a sanitizer\n");
} catch (const std::exception& error) {
  std::fprintf(stderr, "pipeline_benchmark: %s\n", error.what());
  return 1;
}
