#include "core/tracking/health.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>

namespace capstan::tracking {
namespace {

using Eigen::Vector3d;

constexpr double kMemory = 0.25;

/// A report of `seconds` at 15 pairs of images per second whose innovations are `factor` times as large as σ.
class HealthTest : public ::testing::Test {
 protected:
  Snapshot camera(double t) {
    Snapshot s{};
    s.t = s.t_cam = t;
    s.motor_updated = s.camera_updated = s.camera_images = true;
    s.gate = Gate::kOpen;
    s.latency = 0.05;
    for (auto& marker : s.marker) marker.fault = vision::MarkerFault::kNone;
    s.innovation_sigma = Vector3d(0.01, 0.02, 0.001);
    for (int joint = 0; joint < 3; ++joint)
      s.innovation(joint) = factor_(joint) * s.innovation_sigma(joint) * noise_(random_);
    return s;
  }
  void run(double seconds, const std::function<void(Snapshot&, int)>& change = {}) {
    for (int i = 0; i < std::lround(15.0 * seconds); ++i) {
      Snapshot s = camera(i / 15.0);
      if (change) change(s, i);
      report_.add(s);
    }
  }
  std::vector<HealthCheck> checks() const { return healthOf(report_, robot::defaultDescription(), kMemory); }
  HealthCheck check(const std::string& key) const {
    for (const HealthCheck& one : checks())
      if (one.key == key) return one;
    ADD_FAILURE() << "no check " << key;
    return {};
  }
  /// The only check that does not pass is `key`.
  void expectOnly(const std::string& key, HealthVerdict verdict) const {
    for (const HealthCheck& one : checks()) {
      EXPECT_EQ(one.verdict, one.key == key ? verdict : HealthVerdict::kPass) << one.key << ": " << one.value;
      EXPECT_EQ(one.advice.empty(), one.key != key) << one.key;
    }
    EXPECT_EQ(worstOf(checks()), verdict);
  }

  Vector3d factor_{1.0, 1.0, 1.0};
  std::mt19937 random_{5};
  std::normal_distribution<double> noise_;
  TrackReport report_;
};

TEST_F(HealthTest, NothingIsJudgedBeforeTheFirstSample) {
  EXPECT_TRUE(checks().empty());
  EXPECT_EQ(worstOf(checks()), HealthVerdict::kUnknown);
}

TEST_F(HealthTest, AConsistentFilterPasses) {
  run(60.0);
  for (const HealthCheck& one : checks())
    EXPECT_EQ(one.verdict, HealthVerdict::kPass) << one.key << one.value;
  EXPECT_EQ(worstOf(checks()), HealthVerdict::kPass);
}

TEST_F(HealthTest, NisIsNotJudgedFromAFewUpdates) {
  factor_ = Vector3d::Constant(10.0);
  run(2.0);
  EXPECT_EQ(check("nis_q1").verdict, HealthVerdict::kUnknown);
  EXPECT_TRUE(check("nis_q1").value.ends_with("; 30 of the 300 camera updates needed"))
      << check("nis_q1").value;
  EXPECT_EQ(worstOf(checks()), HealthVerdict::kPass) << "the other checks are judged";
}

TEST_F(HealthTest, NisIsJudgedByJointInBothDirections) {
  factor_ = Vector3d(3.0, 0.3, 1.75);
  run(60.0);
  EXPECT_EQ(check("nis_q1").verdict, HealthVerdict::kFail);
  EXPECT_NE(check("nis_q1").advice.find("3.0 times"), std::string::npos) << check("nis_q1").advice;
  EXPECT_EQ(check("nis_q2").verdict, HealthVerdict::kCautious) << "too cautious a filter misleads nobody";
  EXPECT_NE(check("nis_q2").advice.find("Nothing is wrong"), std::string::npos) << check("nis_q2").advice;
  EXPECT_EQ(check("nis_q3").verdict, HealthVerdict::kCautious);
}

/// A camera that is pushed after ten minutes.
TEST_F(HealthTest, NisOfTheNewestUpdatesFailsBeforeTheMeanDoes) {
  run(600.0, [](Snapshot& s, int i) {
    if (i > 15 * 585) s.innovation(1) *= 4.0;
  });
  EXPECT_LT(report_.innovations.nis()(1), HealthLimits{}.nis);
  EXPECT_EQ(check("nis_q2").verdict, HealthVerdict::kFail);
  EXPECT_NE(check("nis_q2").value.find(" in the newest camera updates; 1."), std::string::npos)
      << check("nis_q2").value;
  EXPECT_EQ(check("nis_q1").verdict, HealthVerdict::kPass);
}

TEST_F(HealthTest, TheChecksOfNisAreThoseOfTheJoints) {
  run(60.0);
  const auto nis = nisChecksOf(checks());
  ASSERT_EQ(nis.size(), 3U);
  EXPECT_EQ(nis.back().key, "nis_q3");
  EXPECT_EQ(nis.back().value, check("nis_q3").value) << "with nothing to add once it is judged";
  EXPECT_EQ(worstOf(nis), HealthVerdict::kPass);
}

TEST_F(HealthTest, EveryFaultIsNamedByItsOwnCheck) {
  run(60.0, [](Snapshot& s, int i) {
    if (i % 2 == 0) s.marker[1].fault = vision::MarkerFault::kNoPixels;
  });
  expectOnly("detection_right", HealthVerdict::kCautious);
  report_ = {};
  run(60.0, [](Snapshot& s, int i) {
    if (i % 20 == 0) s.gate = Gate::kJump;
  });
  expectOnly("refused", HealthVerdict::kCautious);
  report_ = {};
  run(60.0, [](Snapshot& s, int) { s.latency = 0.3; });
  expectOnly("latency", HealthVerdict::kFail);
  report_ = {};
  run(60.0, [](Snapshot& s, int i) { s.rescues = static_cast<std::uint64_t>(i == 899); });
  expectOnly("rescues", HealthVerdict::kFail);
  report_ = {};
  run(60.0, [](Snapshot& s, int i) { s.motor_refused = static_cast<std::uint64_t>(i / 100); });
  expectOnly("lost", HealthVerdict::kFail);
  report_ = {};
  run(60.0, [](Snapshot& s, int i) {
    if (i > 100) s.motor_failed[1] = MotorFault::kFrozen;
  });
  expectOnly("encoders", HealthVerdict::kFail);
  EXPECT_NE(check("encoders").value.find("motor 2: frozen since 6.7 s"), std::string::npos);
  report_ = {};
  run(60.0, [](Snapshot& s, int) { s.transmission.scale(0) = 0.05; });
  expectOnly("transmission", HealthVerdict::kCautious);
}

TEST_F(HealthTest, ImagesThatWereBlockedDeliberatelyAreNotJudged) {
  const auto blocked = [](Snapshot& s) {
    s.view_blocked[0] = true;
    s.marker[0].fault = vision::MarkerFault::kNoPixels;
  };
  run(60.0, [&](Snapshot& s, int i) {
    if (i % 5 < 2) blocked(s);
  });
  EXPECT_EQ(check("detection_left").verdict, HealthVerdict::kPass);
  EXPECT_EQ(check("detection_left").value, "100.0 % of 540 images; 360 more were blocked deliberately");
  EXPECT_EQ(check("detection_right").value, "100.0 % of images");
  report_ = {};
  run(60.0, [&](Snapshot& s, int i) {
    if (i % 5 < 2) blocked(s);
    if (i % 5 == 2) s.marker[0].fault = vision::MarkerFault::kNoPixels;
  });
  EXPECT_EQ(check("detection_left").verdict, HealthVerdict::kCautious)
      << "a third of the others has no marker";
  EXPECT_NE(check("detection_left").advice.find("not found in 33 % of the left"), std::string::npos);
  report_ = {};
  run(60.0, [&](Snapshot& s, int) { blocked(s); });
  EXPECT_EQ(check("detection_left").verdict, HealthVerdict::kUnknown);
  EXPECT_EQ(check("detection_left").value, "all 900 images were blocked deliberately");
}

TEST_F(HealthTest, ADelayIsSetWhereTheSessionHasIt) {
  run(60.0, [](Snapshot& s, int) { s.transmission.camera_delay = -0.1; });
  EXPECT_NE(check("transmission").advice.find("reduce camera_delay in the filter options by 0.100 s"),
            std::string::npos);
  report_.live_cameras = true;
  EXPECT_NE(check("transmission").advice.find("reduce cameras.latency in the live set-up by 0.100 s"),
            std::string::npos);
}

TEST_F(HealthTest, ALatencyBeyondTheCountsIsNoMeasurement) {
  run(60.0, [](Snapshot& s, int) { s.latency = 3.0; });
  expectOnly("latency", HealthVerdict::kFail);
  EXPECT_EQ(check("latency").value, "median above 1 s");
  report_ = {};
  run(60.0, [](Snapshot& s, int i) { s.latency = i % 10 == 0 ? 3.0 : 0.05; });
  expectOnly("latency", HealthVerdict::kFail);
  EXPECT_EQ(check("latency").value, "median 50 ms, more than 1 % above 1 s");
  report_ = {};
  run(60.0);
  EXPECT_EQ(check("latency").value, "median 50 ms, 99 % within 50 ms");
}

TEST_F(HealthTest, LiveCamerasOfWhichNoImageIsUsedFail) {
  const auto without_images = [](Snapshot& s, int) { s.camera_updated = s.camera_images = false; };
  report_.live_cameras = true;
  run(1.0, without_images);
  EXPECT_EQ(check("cameras").verdict, HealthVerdict::kUnknown) << "they may still come";
  run(60.0, without_images);
  EXPECT_EQ(check("cameras").verdict, HealthVerdict::kFail);
  EXPECT_EQ(check("cameras").value, "no image was used");
  EXPECT_NE(check("cameras").advice.find("No pair of images came"), std::string::npos);
  report_ = {};
  report_.live_cameras = true;
  run(60.0, [](Snapshot& s, int k) { s.gate = k % 9 == 0 ? Gate::kLeftLost : Gate::kUnregistered; });
  EXPECT_EQ(check("cameras").verdict, HealthVerdict::kFail);
  EXPECT_NE(check("cameras").advice.find("not registered"), std::string::npos);
  report_ = {};
  report_.live_cameras = true;
  run(60.0);
  EXPECT_EQ(check("cameras").verdict, HealthVerdict::kPass);
  EXPECT_EQ(check("cameras").value, "900 of 900 samples used");
  report_ = {};
  run(60.0, without_images);
  EXPECT_EQ(check("cameras").verdict, HealthVerdict::kCautious) << "a robot without cameras";
  EXPECT_NE(check("cameras").advice.find("by the motors alone. No camera"), std::string::npos);
}

TEST_F(HealthTest, ImagesOfAnotherSizeAreNamed) {
  run(60.0, [](Snapshot& s, int) {
    s.gate = Gate::kBothLost;
    for (auto& marker : s.marker) marker.fault = vision::MarkerFault::kWrongImage;
    EXPECT_EQ(gateWords(s), "image of another size or format");
  });
  EXPECT_EQ(check("detection_right").verdict, HealthVerdict::kFail);
  EXPECT_NE(check("detection_right").advice.find("the right camera have another size or format"),
            std::string::npos)
      << check("detection_right").advice;
}

TEST_F(HealthTest, WhatNoImageShowsIsUnknown) {
  run(60.0, [](Snapshot& s, int) { s.gate = Gate::kUnregistered; });
  EXPECT_EQ(check("cameras").verdict, HealthVerdict::kFail);
  EXPECT_NE(check("cameras").advice.find("Register them."), std::string::npos) << check("cameras").advice;
  EXPECT_EQ(check("transmission").verdict, HealthVerdict::kUnknown);
  EXPECT_EQ(check("transmission").value, "not observed");
  for (const HealthCheck& one : checks()) EXPECT_NE(one.key, "refused") << "nothing came to the gate";
  report_ = {};
  run(60.0);
  for (const HealthCheck& one : checks()) EXPECT_NE(one.key, "cameras") << "the other checks say it";
}

TEST_F(HealthTest, LostSamplesAreThoseOfAllSides) {
  SideStatus motors, cameras;
  motors.missing = 3;
  cameras.dropped = 4;
  EXPECT_EQ(lostOf({motors, cameras}), 7U);
}

TEST_F(HealthTest, TheTableHasEveryCheck) {
  run(60.0);
  const base::Table table = healthTable(checks());
  EXPECT_EQ(table.rows.size(), checks().size());
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
}

TEST(InnovationRecordTest, MergesWindowsWithoutLosingAnything) {
  InnovationRecord record;
  const Vector3d sigma(1.0, 1.0, 1.0);
  for (int i = 0; i < 2000; ++i) record.add(0.5 * i, Vector3d(1.0, 2.0, 3.0), sigma);
  EXPECT_EQ(record.length(), 4.0);
  EXPECT_LE(record.windows().size(), InnovationRecord::kMost);
  std::uint64_t count = 0;
  for (const auto& window : record.windows()) {
    count += window.count;
    EXPECT_NEAR((window.nis() - Vector3d(1.0, 4.0, 9.0)).norm(), 0.0, 1e-12);
  }
  EXPECT_EQ(count, 2000U);
  EXPECT_EQ(record.count(), 2000U);
  EXPECT_EQ(record.windows().front().index, 0);
  EXPECT_EQ(record.windows().back().index, 249);
}

TEST(InnovationRecordTest, KeepsGapsAndTimesBeforeZero) {
  InnovationRecord record;
  for (const double t : {-1.5, 100000.2, 100000.4}) record.add(t, Vector3d::Ones(), Vector3d::Ones());
  ASSERT_EQ(record.windows().size(), 2U);
  EXPECT_EQ(record.windows()[0].index, -2);
  EXPECT_EQ(record.windows()[1].count, 2U);
}

TEST(InnovationRecordTest, ExcludesWhatIsNotFinite) {
  InnovationRecord record;
  record.add(0.0, Vector3d::Constant(std::nan("")), Vector3d::Ones());
  record.add(std::nan(""), Vector3d::Ones(), Vector3d::Ones());
  EXPECT_EQ(record.count(), 0U);
  EXPECT_TRUE(std::isnan(record.nis()(0)));
}

TEST(LatencyCountsTest, QuantilesAreThoseOfTheSortedValues) {
  LatencyCounts counts;
  EXPECT_TRUE(std::isnan(counts.quantile(0.5)));
  for (int i = 1; i <= 100; ++i) counts.add(1e-3 * i);
  EXPECT_DOUBLE_EQ(counts.quantile(0.5), 0.050);
  EXPECT_DOUBLE_EQ(counts.quantile(0.99), 0.099);
  counts.add(50.0);
  counts.add(std::nan(""));
  EXPECT_EQ(counts.count(), 101U);
  EXPECT_TRUE(std::isinf(counts.quantile(1.0))) << "longer than what is counted";
  EXPECT_DOUBLE_EQ(counts.quantile(0.99), 0.100);
}

}  // namespace
}  // namespace capstan::tracking
