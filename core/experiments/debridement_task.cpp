#include "core/experiments/debridement_task.h"

#include <algorithm>
#include <cmath>

#include "core/experiments/require_option.h"
#include "core/experiments/tool_rig.h"

namespace capstan::experiments {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kOpen = 0.8, kHeld = 0.15;  // openings of the jaws [rad]
constexpr int kMostPieces = 12;              // most pieces in addition to length / piece

/// One arm that executes the task.
class Worker {
 public:
  Worker(const robot::Description& robot, const simulation::ToolTruth& truth,
         const learning::CorrectionModel& model, DebridementMethod method,
         const DebridementTaskOptions& options)
      : scene_(debridementScene(robot)),
        rig_(robot, truth, scene_.start, options.seed + 2),
        model_(model),
        method_(method),
        options_(options),
        detection_(options.seed, "detection"),
        here_(scene_.pose({0.0, 0.0, 0.0}, 0.0)) {
    const double side = 0.5 * DebridementScene::kSide;
    receptacle_ = scene_.pose({0.0, side + 0.015, DebridementScene::kHeight + 0.02}, 0.0);
  }

  FragmentRun clear(const Fragment& fragment) {
    run_ = {};
    const double begin = rig_.time();
    const Isometry3d lies = scene_.pose(fragment.place, fragment.yaw), found = detected(fragment);
    rig_.rest(DebridementTaskOptions::kFindTime);
    rig_.moveJaws(kOpen, DebridementTaskOptions::kJawTime);
    goTo(above(found));
    goTo(found);
    judgeGrasp(lies);
    rig_.moveJaws(kHeld, DebridementTaskOptions::kJawTime);
    goTo(above(found));
    goTo(receptacle_);
    run_.cleared =
        run_.grasped && acrossTheFloor(seenTruly(), receptacle_) <= DebridementTaskOptions::kReceptacle;
    rig_.moveJaws(kOpen, DebridementTaskOptions::kJawTime);
    run_.time = rig_.time() - begin;
    return run_;
  }

 private:
  Isometry3d above(const Isometry3d& pose) const {
    Isometry3d higher = pose;
    higher.translation() += DebridementTaskOptions::kHover * scene_.axes.col(2);
    return higher;
  }
  /// Tool pose as measured by ideal cameras with the same registration as the fragments.
  Isometry3d seenTruly() const { return rig_.camera().registration() * rig_.robot().arm().pose(); }
  double acrossTheFloor(const Isometry3d& a, const Isometry3d& b) const {
    return (scene_.axes.leftCols<2>().transpose() * (a.translation() - b.translation())).norm();
  }

  Isometry3d detected(const Fragment& fragment) {
    const double across = DebridementTaskOptions::kFindSigma;
    const Vector3d off(detection_.normal(0.0, across), detection_.normal(0.0, across),
                       detection_.normal(0.0, DebridementTaskOptions::kFindDepthSigma));
    return scene_.pose(fragment.place + off,
                       fragment.yaw + detection_.normal(0.0, DebridementTaskOptions::kFindYawSigma));
  }

  void judgeGrasp(const Isometry3d& fragment) {
    const Isometry3d jaws = seenTruly();
    const Vector3d off = fragment.linear().transpose() * (jaws.translation() - fragment.translation());
    run_.off = off.norm();
    run_.rotation_error =
        Eigen::Quaterniond(jaws.linear()).angularDistance(Eigen::Quaterniond(fragment.linear()));
    run_.grasped = off.tail<2>().norm() <= options_.capture && std::abs(off.x()) <= options_.capture &&
                   run_.rotation_error <= DebridementTaskOptions::kCaptureRotation;
  }

  void goTo(const Isometry3d& goal) {
    if (go(goal)) here_ = goal;
    rig_.rest(DebridementTaskOptions::kSettle);
  }

  /// Moves to `goal`. Returns false when it is out of reach; then the arm does not move.
  bool go(const Isometry3d& goal) {
    switch (method_) {
      case DebridementMethod::kReplanning:
        return goObserving(goal);
      case DebridementMethod::kCorrected:
        return follow(planned(goal, options_.mode));
      case DebridementMethod::kWhereUncertain:
        return goWhereConfident(goal);
      case DebridementMethod::kOpenLoop:
        break;
    }
    return follow(planned(goal, learning::CorrectionMode::kNone));
  }

  bool follow(const std::vector<learning::CorrectedWaypoint>& path) {
    const double begin = rig_.time();
    const int refused = rig_.refused();
    const bool began = rig_.follow(path);
    run_.moving += rig_.time() - begin;
    run_.refused += rig_.refused() - refused + (began ? 0 : 1);
    return began;
  }

  std::vector<learning::CorrectedWaypoint> planned(const Isometry3d& goal, learning::CorrectionMode mode) {
    rig_.rest(DebridementTaskOptions::kPlanTime);
    return learning::correctedPath(
        model_, straightMotion(here_, goal, DebridementTaskOptions::kFast, options_.waypoints),
        {mode, rig_.reachable(), rig_.commanded()});
  }

  bool goWhereConfident(const Isometry3d& goal) {
    std::vector<learning::CorrectedWaypoint> path = planned(goal, learning::CorrectionMode::kFullTrajectory);
    const std::size_t whole = path.size();
    path.resize(learning::nextObservation(path, 0) + 1);
    return follow(path) && (path.size() == whole || goObserving(goal));
  }

  /// Moves to `goal` piece by piece: observes the tool and corrects the next piece by the offset between
  /// commanded and observed pose.
  bool goObserving(const Isometry3d& goal) {
    const double whole = (goal.translation() - here_.translation()).norm();
    const int most = kMostPieces + static_cast<int>(whole / DebridementTaskOptions::kPiece);
    for (int piece = 0; piece < most; ++piece) {
      const auto observed = rig_.look(DebridementTaskOptions::kLook);
      ++run_.observations;
      if (!observed) continue;
      const double left = std::sqrt(learning::squaredDistance(*observed, goal, learning::kLever));
      if ((goal.translation() - observed->translation()).norm() <= options_.near && piece > 0) return true;
      rig_.rest(DebridementTaskOptions::kPlanTime);
      const Isometry3d next =
          learning::poseBetween(*observed, goal, std::min(1.0, DebridementTaskOptions::kPiece / left));
      const Isometry3d command = learning::offsetObserved(rig_.commanded(), *observed) * next;
      const learning::WithinReach reached =
          learning::withinReach(command, rig_.commanded(), rig_.commanded(), rig_.reachable());
      const auto motion = straightMotion(rig_.commanded(), reached.pose, DebridementTaskOptions::kSlow, 2);
      if (!follow({{motion[0].t, *observed, motion[0].pose}, {motion[1].t, next, motion[1].pose}}))
        return false;
    }
    return true;
  }

  DebridementScene scene_;
  ToolRig rig_;
  const learning::CorrectionModel& model_;
  DebridementMethod method_;
  const DebridementTaskOptions& options_;
  base::Random detection_;
  Isometry3d here_, receptacle_;
  FragmentRun run_;
};

}  // namespace

void checkDebridementTask(const DebridementTaskOptions& options) {
  requireOption("fragments", options.fragments, 1, 100'000);
  requireOption("near [m]", options.near, 1e-4, 1.0);
  requireOption("waypoints", options.waypoints, 2, 10'000);
  requireOption("beside [m]", options.beside.cwiseAbs().maxCoeff(), 0.0, 0.1);
  requireOption("capture [m]", options.capture, 1e-4, 0.1);
}

std::vector<FragmentRun> debridementTask(const robot::Description& robot, const simulation::ToolTruth& truth,
                                         const learning::CorrectionModel& model, DebridementMethod method,
                                         const DebridementTaskOptions& options,
                                         const base::Progress* progress) {
  checkDebridementTask(options);
  Worker worker(robot, truth, model, method, options);
  base::Random random(options.seed, "fragments");
  std::vector<FragmentRun> runs;
  for (int k = 0; k < options.fragments && !(progress && progress->cancelled()); ++k) {
    Fragment fragment = drawnFragment(random, 0.0, DebridementTaskOptions::kMostYaw);
    fragment.place += options.beside;
    runs.push_back(worker.clear(fragment));
  }
  return runs;
}

}  // namespace capstan::experiments
