#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/live/occlusion.h"
#include "core/simulation/simulation_request.h"
#include "core/simulation/truth.h"
#include "tests/core/tracking/pipeline_scene.h"

namespace capstan::tracking::test {

/// A block transfer of the default robot: joint 1 turns on a pulley of 59 mm where the robot file
/// says 63.095.
struct Session {
  tracking::SourceInfo info;
  std::vector<Sample> samples;
};

/// `occlusion` in percent, `rate` of the cameras [1/s].
inline Session transfer(double duration, std::uint64_t seed, double occlusion = 0.0, double rate = 15.0) {
  simulation::SimulationRequest request;
  request.duration = duration;
  request.images = false;
  request.seed = seed;
  simulation::SimulatedOptions options = simulation::optionsOf(request);
  options.truth.cameras.rate = rate;
  simulation::SimulatedSource source(options);
  const live::OcclusionSchedule schedule{.percentage = occlusion};
  Session session{source.info(), {}};
  double t = 0.0;
  for (Sample sample; source.next(sample);) {
    if (const auto* motor = std::get_if<MotorSample>(&sample)) t = motor->t;
    source.block(schedule.blockedAt(t), schedule.blockedAt(t));
    session.samples.push_back(sample);
  }
  return session;
}

inline const Session& twoMinutes() {
  static const Session session = transfer(120.0, 31);
  return session;
}

struct Tracked {
  TrackReport report;
  Snapshot last;
};

/// Errors count from the time `from` on [s].
inline Tracked tracked(const Session& session, const robot::Description& robot, FilterKind filter,
                       double from = 0.0) {
  tracking::SourceInfo info = session.info;
  info.robot = robot;
  TrackingOptions options;
  options.filter = filter;
  TrackingPipeline pipeline = makePipeline(info, options);
  ListSource source(session.samples);
  TrackReport report;
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    if (s.t >= from) report.add(s);
  });
  return {report, pipeline.snapshot()};
}

inline robot::Description withRadius(robot::Description robot, double radius) {
  robot.drives[0].link_radius = radius;
  return robot;
}

/// Motors that count `offset` [rad] more than they turned, from the first sample on.
inline Session withMotorOffset(Session session, const Eigen::Vector3d& offset) {
  for (Sample& sample : session.samples)
    if (auto* motor = std::get_if<MotorSample>(&sample)) motor->position += offset;
  return session;
}

inline Session withMovedCamera(Session session, const Eigen::Vector3d& shift) {
  for (Sample& sample : session.samples)
    if (auto* tip = std::get_if<TipSample>(&sample)) tip->position += shift;
  return session;
}

}  // namespace capstan::tracking::test
