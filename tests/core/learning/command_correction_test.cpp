// Paths through a correction whose error is known: what ends where, what is within reach, when to look.
#include "core/learning/model/command_correction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/learning/poses/next_observation.h"
#include "core/learning/poses/rotation_vector.h"

namespace capstan::learning {
namespace {

Eigen::Isometry3d pose(const Eigen::Vector3d& position,
                       const Eigen::Vector3d& rotation = Eigen::Vector3d::Zero()) {
  Eigen::Isometry3d made = Eigen::Isometry3d::Identity();
  made.linear() = turnBy(rotation).toRotationMatrix();
  made.translation() = position;
  return made;
}

/// A correction of some millimetres, learned within 5 cm of the origin; rigidly off by centimetres.
const CorrectionModel& model() {
  static const CorrectionModel learned = [] {
    base::Random random(1, "states");
    const auto draw = [&](double size) -> Eigen::Vector3d {
      return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    std::vector<State> states;
    while (states.size() < 400) {
      State state;
      state.pair.observed = pose(draw(0.05), draw(0.3));
      state.velocity << draw(0.1), draw(0.5);
      const Eigen::Vector3d p = state.pair.observed.translation();
      state.pair.commanded = pose({0.02, -0.01, 0.015}, {0.1, 0.0, -0.1}) * state.pair.observed;
      state.pair.commanded.translation() +=
          Eigen::Vector3d(4e-3 * std::sin(40.0 * p.x()) + 0.05 * state.velocity[0], 3e-3 * p.y() / 0.05, 0.0);
      states.push_back(state);
    }
    CorrectionOptions options;
    options.likelihood_points = 200;
    options.inducing_points = 150;
    return CorrectionModel::trained(states, options);
  }();
  return learned;
}

std::vector<Waypoint> line(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, int count = 10) {
  std::vector<Waypoint> way;
  for (int k = 0; k < count; ++k)
    way.push_back({0.2 * k, poseBetween(from, to, static_cast<double>(k) / (count - 1))});
  return way;
}

double apart(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return std::sqrt(squaredDistance(a, b, kLever));
}

TEST(PlannedVelocities, areThoseOfTheLine) {
  const auto way = line(pose({0, 0, 0}), pose({0.018, 0, -0.009}, {0, 0.36, 0}));  // in 1.8 s
  for (const Vector6d& v : plannedVelocities(way)) {
    EXPECT_LT((v.head<3>() - Eigen::Vector3d(0.01, 0, -0.005)).norm(), 1e-12);
    EXPECT_LT((v.tail<3>() - Eigen::Vector3d(0, 0.2, 0)).norm(), 1e-9);
  }
}

TEST(CorrectedPath, atItsEndIsWhatTheModelCorrects) {
  const auto way = line(pose({-0.02, 0.01, 0.0}), pose({0.03, -0.02, 0.02}, {0.1, 0.1, 0.0}));
  const Vector6d velocity = plannedVelocities(way).back();
  const Corrected goal = model().correct(way.back().pose, velocity);
  for (const CorrectionMode mode : {CorrectionMode::kEndPoint, CorrectionMode::kFullTrajectory}) {
    const auto path = correctedPath(model(), way, {mode, {}, {}});
    ASSERT_EQ(path.size(), way.size());
    EXPECT_LT(apart(path.back().command, goal.pose), 1e-12);
    EXPECT_DOUBLE_EQ(path.back().confidence, goal.confidence);
    EXPECT_TRUE(withinReach(path));
  }
}

TEST(CorrectedPath, endPointIsStraightAndFullTrajectoryCorrectsEachWaypoint) {
  const auto way = line(pose({-0.04, 0, 0}), pose({0.04, 0, 0}));
  const auto straight = correctedPath(model(), way, {CorrectionMode::kEndPoint, {}, {}});
  const auto whole = correctedPath(model(), way, {CorrectionMode::kFullTrajectory, {}, {}});
  const std::vector<Vector6d> velocity = plannedVelocities(way);
  for (std::size_t k = 0; k < way.size(); ++k) {
    EXPECT_LT(apart(whole[k].command, model().correct(way[k].pose, velocity[k]).pose), 1e-12);
    const double share = static_cast<double>(k) / 9.0;
    EXPECT_LT(
        apart(straight[k].command, poseBetween(straight.front().command, straight.back().command, share)),
        1e-9);
  }
  EXPECT_GT(apart(straight[2].command, whole[2].command), 5e-4);  // what is bent between the ends
}

TEST(CorrectedPath, beginsWhereTheRobotWas) {
  const auto way = line(pose({-0.02, 0, 0}), pose({0.02, 0, 0}));
  const Eigen::Isometry3d before = pose({0.01, 0.01, 0.01});
  for (const CorrectionMode mode :
       {CorrectionMode::kNone, CorrectionMode::kEndPoint, CorrectionMode::kFullTrajectory})
    EXPECT_LT(apart(correctedPath(model(), way, {mode, {}, before}).front().command, before), 1e-12);
}

TEST(CorrectedPath, withoutCorrectionAsksForWhatIsDesired) {
  const auto way = line(pose({-0.02, 0, 0}), pose({0.02, 0, 0}));
  for (const CorrectedWaypoint& waypoint : correctedPath(model(), way, {CorrectionMode::kNone, {}, {}}))
    EXPECT_EQ(apart(waypoint.command, waypoint.desired), 0.0);
}

TEST(CorrectedPath, fadesToTheRigidOffsetBeyondTheData) {
  const auto way = line(pose({0.03, 0, 0}), pose({0.25, 0, 0}), 23);
  const auto path = correctedPath(model(), way, {CorrectionMode::kFullTrajectory, {}, {}});
  EXPECT_LT(apart(path.back().command, model().offset() * way.back().pose), 1e-9);
  EXPECT_LT(path.back().confidence, 1e-6);
  for (std::size_t k = 1; k < path.size();
       ++k) {  // and smoothly: by no more than what is learned a centimetre
    const double now = apart(path[k].command, model().offset() * way[k].pose);
    const double before = apart(path[k - 1].command, model().offset() * way[k - 1].pose);
    EXPECT_LT(std::abs(now - before), 6e-3);
  }
}

TEST(CorrectedPath, neverLeavesTheLimits) {
  base::Random random(7, "walls");
  int shrunk = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const double wall = random.uniform(0.0, 0.07);
    const Reachable inside = [wall](const Eigen::Isometry3d& command) {
      return command.translation().x() <= wall;
    };
    const auto way = line(pose({-0.04, 0, 0}), pose({random.uniform(-0.02, 0.05), 0.02, 0}));
    for (const CorrectionMode mode :
         {CorrectionMode::kNone, CorrectionMode::kEndPoint, CorrectionMode::kFullTrajectory})
      for (const CorrectedWaypoint& waypoint : correctedPath(model(), way, {mode, inside, {}})) {
        if (waypoint.limit == ReachLimit::kNowhere)
          EXPECT_GT(waypoint.desired.translation().x(), wall);
        else
          EXPECT_TRUE(inside(waypoint.command));
        shrunk += waypoint.limit == ReachLimit::kCorrection || waypoint.limit == ReachLimit::kOffset;
      }
  }
  EXPECT_GT(shrunk, 50);
}

TEST(WithinReach, shrinksFirstTheCorrectionThenTheOffset) {
  const Eigen::Isometry3d desired = pose({0, 0, 0}), rigid = pose({0.04, 0, 0}),
                          corrected = pose({0.04, 0.02, 0}, {0, 0, 0.2});
  const auto below = [](double x, double y) -> Reachable {
    return
        [x, y](const Eigen::Isometry3d& p) { return p.translation().x() <= x && p.translation().y() <= y; };
  };
  EXPECT_EQ(withinReach(corrected, rigid, desired, {}).limit, ReachLimit::kNone);
  EXPECT_EQ(withinReach(corrected, rigid, desired, below(1, 1)).limit, ReachLimit::kNone);
  const WithinReach part = withinReach(corrected, rigid, desired, below(1, 0.005));
  EXPECT_EQ(part.limit, ReachLimit::kCorrection);
  EXPECT_NEAR(part.share, 0.25, 1e-5);
  EXPECT_LT(apart(part.pose, pose({0.04, 0.005, 0}, {0, 0, 0.05})), 1e-6);
  const WithinReach offset = withinReach(corrected, rigid, desired, below(0.03, 1));
  EXPECT_EQ(offset.limit, ReachLimit::kOffset);
  EXPECT_LT(apart(offset.pose, pose({0.03, 0, 0})), 1e-6);
  EXPECT_EQ(withinReach(corrected, rigid, desired, below(-1, 1)).limit, ReachLimit::kNowhere);
}

TEST(CorrectedPath, refusesWhatIsNoMotion) {
  EXPECT_THROW(correctedPath(model(), {{0.0, pose({0, 0, 0})}}, {}), base::InputError);
  EXPECT_THROW(correctedPath(model(), {{1.0, pose({0, 0, 0})}, {1.0, pose({0.01, 0, 0})}}, {}),
               base::InputError);
}

std::vector<CorrectedWaypoint> confident(const std::vector<double>& confidence) {
  std::vector<CorrectedWaypoint> path;
  for (const double each : confidence) {
    CorrectedWaypoint waypoint;
    waypoint.t = static_cast<double>(path.size());
    waypoint.desired = pose({0.004 * waypoint.t, 0, 0});  // every 4 mm
    waypoint.confidence = each;
    path.push_back(waypoint);
  }
  return path;
}

TEST(NextLook, isAtTheEndWhereAllIsSure) {
  EXPECT_EQ(nextObservation(confident({0.9, 1.0, 0.95, 0.9, 0.9}), 0), 4U);
}

TEST(NextLook, comesEachCentimetreWhereItIsNot) {
  const auto path = confident({0.4, 0.4, 0.4, 0.4, 0.4, 0.4, 0.9});
  EXPECT_EQ(nextObservation(path, 0), 3U);  // 12 mm on
  EXPECT_EQ(nextObservation(path, 3), 6U);
  EXPECT_EQ(nextObservation(path, 6), 6U);
}

TEST(NextLook, goesInOnePieceToTheLastThatIsSure) {
  EXPECT_EQ(nextObservation(confident({0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.1, 0.1}), 0), 5U);
}

TEST(OffsetSeen, takesWhatIsSeenToWhatWasTold) {
  const Eigen::Isometry3d commanded = pose({0.1, 0, 0}, {0.1, 0.2, 0}),
                          observed = pose({0.12, 0.01, 0}, {0, 0.3, 0});
  EXPECT_LT(apart(offsetObserved(commanded, observed) * observed, commanded), 1e-12);
}

}  // namespace
}  // namespace capstan::learning
