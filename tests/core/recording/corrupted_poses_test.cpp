// Recordings gone wrong in many ways: each is cleaned with reasons or refused, none is silently worse than
// the rigid offset.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/learning/model/learn.h"
#include "core/recording/pose_table.h"
#include "tests/support/sample_poses.h"

namespace capstan::recording {
namespace {

using learning::RawMotion;
using learning::RawPose;
using learning::Reason;
using learning::StreamKind;

constexpr std::size_t kCamera = 0;

std::vector<RawMotion> sound(std::uint64_t seed, const std::string& file = "sample.csv") {
  testing::SamplePoses sample;
  sample.outliers = sample.placeholders = 0;
  sample.seed = seed;
  return parsePoseTable(testing::samplePoseTable(sample), file);
}

learning::LearningOptions quick() {
  learning::LearningOptions options;
  options.correction.likelihood_points = 200;
  options.correction.inducing_points = 200;
  options.correction.members = 1;
  options.correction.threads = 1;
  return options;
}

double rmsOf(const std::vector<Eigen::Isometry3d>& corrected, const std::vector<learning::State>& states) {
  double squares = 0.0;
  for (std::size_t k = 0; k < states.size(); ++k)
    squares += (corrected[k].translation() - states[k].pair.commanded.translation()).squaredNorm();
  return std::sqrt(squares / static_cast<double>(states.size()));
}

/// Sound motions that nothing is learned from, and what the rigid offset of sound motions leaves of them.
struct Yardstick {
  std::vector<learning::State> states;
  double rigid = 0.0, learned = 0.0;
};
const Yardstick& yardstick() {
  static const Yardstick one = [] {
    Yardstick made;
    learning::LearningOptions options = quick();
    made.states = learning::prepare(sound(2), options).states;
    made.learned = rmsOf(learning::learn(sound(1), options).model.correct(made.states), made.states);
    options.rigid = true;
    made.rigid = rmsOf(learning::learn(sound(1), options).model.correct(made.states), made.states);
    return made;
  }();
  return one;
}

using Corruption = std::function<void(std::vector<RawMotion>&, base::Random&)>;

learning::LearningReport learnedFrom(const Corruption& corrupt) {
  std::vector<RawMotion> motions = sound(1);
  base::Random random(3, "corruption");
  corrupt(motions, random);
  return learning::learn(motions, quick());
}

void expectNoWorse(const learning::LearningReport& report) {
  EXPECT_LT(rmsOf(report.model.correct(yardstick().states), yardstick().states), yardstick().rigid);
}

void eachObservation(std::vector<RawMotion>& motions, const std::function<void(RawPose&)>& change) {
  for (RawMotion& motion : motions)
    for (RawPose& pose : motion.streams[kCamera]) change(pose);
}

TEST(CorruptedPoses, TheYardstickMeasures) {
  EXPECT_LT(yardstick().learned, 0.5 * yardstick().rigid) << "there is something to lose";
}

TEST(CorruptedPoses, JumpsWhereTheMarkerWasHidden) {
  const auto report = learnedFrom([](auto& motions, auto& random) {
    for (RawMotion& motion : motions)
      for (std::size_t k = 20; k < 30; ++k)
        for (double& x : motion.streams[kCamera][k].position) x += random.normal(0.0, 0.1);
  });
  EXPECT_GT(report.cleaning.count(Reason::kOutlier), 100U);
  expectNoWorse(report);
}

TEST(CorruptedPoses, AThirdOfTheObservationsSomewhereElse) {
  const auto report = learnedFrom([](auto& motions, auto& random) {
    eachObservation(motions, [&](RawPose& pose) {
      if (random.uniform(0.0, 1.0) < 0.3)
        for (double& x : pose.position) x += random.uniform(-0.2, 0.2);
    });
  });
  EXPECT_LT(report.cleaning.kept(), report.cleaning.reason.size());
  expectNoWorse(report);
}

TEST(CorruptedPoses, StampsTwice) {
  const auto report = learnedFrom([](auto& motions, auto&) {
    for (RawMotion& motion : motions)
      for (std::size_t k = 10; k < 40; k += 3)
        motion.streams[kCamera][k].t = motion.streams[kCamera][k - 1].t;
  });
  EXPECT_GE(report.prepared.screen.count(StreamKind::kCamera, Reason::kRepeat), 190U);
  expectNoWorse(report);
}

TEST(CorruptedPoses, StampsThatGoBack) {
  const auto report = learnedFrom([](auto& motions, auto&) {
    for (RawMotion& motion : motions) motion.streams[kCamera][30].t -= 0.2;
  });
  EXPECT_GE(report.prepared.screen.count(StreamKind::kCamera, Reason::kBackInTime), 19U);
  expectNoWorse(report);
}

TEST(CorruptedPoses, NumbersThatAreNone) {
  const auto report = learnedFrom([](auto& motions, auto& random) {
    eachObservation(motions, [&](RawPose& pose) {
      if (random.uniform(0.0, 1.0) < 0.1) pose.position.y() = std::numeric_limits<double>::quiet_NaN();
      if (random.uniform(0.0, 1.0) < 0.05) pose.quaternion.x() = std::numeric_limits<double>::infinity();
    });
  });
  EXPECT_GT(report.prepared.screen.count(StreamKind::kCamera, Reason::kNotFinite), 100U);
  expectNoWorse(report);
}

TEST(CorruptedPoses, IdentityWhereNothingWasSeen) {
  const auto report = learnedFrom([](auto& motions, auto& random) {
    eachObservation(motions, [&](RawPose& pose) {
      if (random.uniform(0.0, 1.0) > 0.2) return;
      pose.position.setZero();
      pose.quaternion = Eigen::Vector4d::UnitW();
    });
  });
  EXPECT_GT(report.prepared.screen.count(StreamKind::kCamera, Reason::kPlaceholder), 100U);
  expectNoWorse(report);
}

TEST(CorruptedPoses, OneTrajectoryMirrored) {
  const auto report = learnedFrom([](auto& motions, auto&) {
    for (RawPose& pose : motions[4].streams[kCamera]) pose.position.x() = 0.1 - pose.position.x();
  });
  EXPECT_LT(report.cleaning.kept(), report.cleaning.reason.size());
  expectNoWorse(report);
}

TEST(CorruptedPoses, AxesSwappedInSomeTrajectories) {
  const auto report = learnedFrom([](auto& motions, auto&) {
    for (std::size_t m = 0; m < motions.size(); m += 5)
      for (RawPose& pose : motions[m].streams[kCamera]) std::swap(pose.position.x(), pose.position.z());
  });
  EXPECT_LT(report.cleaning.kept(), report.cleaning.reason.size());
  expectNoWorse(report);
}

/// What learning complains of.
std::string refusalOf(const std::vector<RawMotion>& motions) {
  try {
    learning::learn(motions, quick());
    return "nothing";
  } catch (const base::InputError& error) {
    return error.what();
  }
}

std::string refusalOf(const Corruption& corrupt) {
  std::vector<RawMotion> motions = sound(1);
  base::Random random(3, "corruption");
  corrupt(motions, random);
  return refusalOf(motions);
}

/// Of half a table, everywhere wrong, behind a sound one.
std::string refusalBesideSound(const std::function<void(RawPose&)>& commanded,
                               const std::function<void(RawPose&)>& observed) {
  std::vector<RawMotion> motions = sound(1), other = sound(2, "other.csv");
  other.resize(other.size() / 2);
  eachObservation(other, observed);
  for (RawMotion& motion : other)
    for (RawPose& pose : motion.streams[static_cast<std::size_t>(StreamKind::kCommand)]) commanded(pose);
  motions.insert(motions.end(), other.begin(), other.end());
  return refusalOf(motions);
}

TEST(CorruptedPoses, MillimetresInOneColumn) {
  const std::string refusal = refusalOf([](auto& motions, auto&) {
    eachObservation(motions, [](RawPose& pose) { pose.position.x() *= 1e3; });
  });
  EXPECT_NE(refusal.find("Give x of the camera in metres"), std::string::npos) << refusal;
}

TEST(CorruptedPoses, MillimetresInAllColumns) {
  const std::string refusal = refusalOf(
      [](auto& motions, auto&) { eachObservation(motions, [](RawPose& pose) { pose.position *= 1e3; }); });
  EXPECT_NE(refusal.find("Give x, y, z of the camera in metres"), std::string::npos) << refusal;
}

TEST(CorruptedPoses, StampsInMilliseconds) {
  const std::string refusal = refusalOf([](auto& motions, auto&) {
    for (RawMotion& motion : motions)
      for (auto& stream : motion.streams)
        for (RawPose& pose : stream) pose.t *= 1e3;
  });
  EXPECT_NE(refusal.find("stamps of the command"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("seconds"), std::string::npos) << refusal;
}

TEST(CorruptedPoses, QuaternionsThatAreNone) {
  const std::string refusal = refusalOf(
      [](auto& motions, auto&) { eachObservation(motions, [](RawPose& pose) { pose.quaternion *= 0.7; }); });
  EXPECT_NE(refusal.find("camera"), std::string::npos) << refusal;
}

TEST(CorruptedPoses, MillimetresInAllOfATable) {
  const auto milli = [](RawPose& pose) { pose.position *= 1e3; };
  const std::string refusal = refusalBesideSound(milli, milli);
  EXPECT_NE(refusal.find("other.csv: positions of the camera"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("in metres"), std::string::npos) << refusal;
}

TEST(CorruptedPoses, AxesSwappedInATable) {
  const std::string refusal = refusalBesideSound(
      [](RawPose&) {}, [](RawPose& pose) { std::swap(pose.position.x(), pose.position.z()); });
  EXPECT_NE(refusal.find("other.csv: poses"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("the order of axes"), std::string::npos) << refusal;
}

TEST(CorruptedPoses, QuaternionsInAnotherOrderInATable) {
  const std::string refusal = refusalBesideSound([](RawPose&) {},
                                                 [](RawPose& pose) {
                                                   const Eigen::Vector4d q = pose.quaternion;
                                                   pose.quaternion << q[3], q[0], q[1], q[2];
                                                 });
  EXPECT_NE(refusal.find("other.csv: quaternions"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace capstan::recording
