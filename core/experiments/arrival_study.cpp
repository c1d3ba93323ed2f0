#include "core/experiments/arrival_study.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/experiments/require_option.h"
#include "core/experiments/tool_rig.h"

namespace capstan::experiments {
namespace {

using learning::CorrectionMode;

struct Arrival {
  std::size_t location = 0;
  Eigen::Vector3d off = Eigen::Vector3d::Zero();  ///< observed − desired position [m]
  double angle = 0.0, confidence = 0.0;
};

std::vector<std::size_t> shuffled(std::size_t count, base::Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  return order;
}

double deviationOf(const std::vector<double>& x, double mean) {
  double squares = 0.0;
  for (const double one : x) squares += (one - mean) * (one - mean);
  return x.size() > 1 ? std::sqrt(squares / static_cast<double>(x.size() - 1)) : 0.0;
}

double meanOf(const std::vector<double>& x) {
  return x.empty() ? 0.0 : std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

/// Repeatability, pooled over locations: √(Σ Σ (x − x̄_location)² / Σ (arrivals − 1)).
Eigen::Vector3d repeatabilityOf(const std::vector<Arrival>& repetitions, std::size_t locations) {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  double freedom = 0.0;
  for (std::size_t l = 0; l < locations; ++l) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (const Arrival& visit : repetitions)
      if (visit.location == l) sum += visit.off, count += 1.0;
    if (count < 2.0) continue;
    for (const Arrival& visit : repetitions)
      if (visit.location == l) squares += (visit.off - sum / count).cwiseAbs2();
    freedom += count - 1.0;
  }
  return (squares / std::max(freedom, 1.0)).cwiseSqrt();
}

ArrivalErrors summed(const std::vector<Arrival>& repetitions, std::size_t locations) {
  ArrivalErrors errors;
  std::vector<double> distance, angle, confidence;
  for (const Arrival& visit : repetitions) {
    errors.mean += visit.off.cwiseAbs() / static_cast<double>(repetitions.size());
    distance.push_back(visit.off.norm());
    angle.push_back(visit.angle);
    confidence.push_back(visit.confidence);
  }
  errors.repeatability = repeatabilityOf(repetitions, locations);
  errors.distance = meanOf(distance);
  errors.distance_deviation = deviationOf(distance, errors.distance);
  errors.angle = meanOf(angle);
  errors.angle_deviation = deviationOf(angle, errors.angle);
  errors.confidence = meanOf(confidence);
  errors.arrived = static_cast<int>(repetitions.size());
  errors.distances = std::move(distance);
  return errors;
}

/// Runs all arrivals of one mode.
std::vector<Arrival> arrivalsOf(const robot::Description& robot, const simulation::ToolTruth& truth,
                                const learning::CorrectionModel& model, CorrectionMode mode,
                                const ArrivalOptions& options, const base::Progress* progress) {
  const DebridementScene scene = debridementScene(robot);
  ToolRig rig(robot, truth, scene.start, options.seed + 1);
  base::Random random(options.seed, "arrivals");
  std::vector<Eigen::Isometry3d> places;
  for (int k = 0; k < options.locations; ++k) {
    const Fragment fragment = drawnFragment(random, 0.0, ArrivalOptions::kMostYaw);
    places.push_back(scene.pose(fragment.place, fragment.yaw));
  }
  std::vector<Arrival> repetitions;
  Eigen::Isometry3d from = scene.pose({0.0, 0.0, DebridementScene::kHeight}, 0.0);
  for (int visit = 0; visit < options.repetitions; ++visit)
    for (const std::size_t location : shuffled(places.size(), random)) {
      if (progress && progress->cancelled()) return repetitions;
      const Eigen::Isometry3d& goal = places[location];
      const std::vector<learning::CorrectedWaypoint> path =
          learning::correctedPath(model, straightMotion(from, goal, options.speed, options.waypoints),
                                  {mode, rig.reachable(), rig.commanded()});
      if (!rig.follow(path)) continue;
      from = goal;
      rig.rest(ArrivalOptions::kSettle);
      const Eigen::Isometry3d observed =
          rig.camera().registration() * rig.robot().arm().pose() * rig.camera().mounting();
      repetitions.push_back(
          {location, observed.translation() - goal.translation(),
           Eigen::Quaterniond(observed.linear()).angularDistance(Eigen::Quaterniond(goal.linear())),
           path.back().confidence});
    }
  return repetitions;
}

}  // namespace

void checkArrival(const ArrivalOptions& options) {
  requireOption("locations", options.locations, 1, 10'000);
  requireOption("arrivals", options.repetitions, 2, 10'000);
  requireOption("waypoints", options.waypoints, 2, 10'000);
  requireOption("speed [m/s]", options.speed, 1e-4, 1.0);
}

ArrivalReport arrivalStudy(const robot::Description& robot, const simulation::ToolTruth& truth,
                           const learning::CorrectionModel& model, const ArrivalOptions& options,
                           const base::Progress* progress) {
  checkArrival(options);
  ArrivalReport report;
  base::parallelFor(learning::kCorrectionModes, options.threads, [&](std::size_t mode) {
    report[mode] =
        summed(arrivalsOf(robot, truth, model, static_cast<CorrectionMode>(mode), options, progress),
               static_cast<std::size_t>(options.locations));
  });
  return report;
}

}  // namespace capstan::experiments
