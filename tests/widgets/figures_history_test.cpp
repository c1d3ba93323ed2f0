#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/base/units.h"
#include "tests/widgets/synthetic_motion.h"
#include "widgets/figures/joint_history.h"

namespace capstan::widgets {
namespace {

JointHistory filled(std::size_t rows, int milliseconds, int step = 1) {
  JointHistory history(rows);
  for (int ms = 0; ms < milliseconds; ms += step) history.append(syntheticSnapshot(ms * 1e-3));
  return history;
}

TEST(JointHistory, KeepsValuesInScreenUnits) {
  const JointHistory history = filled(4096, 1000);
  const tracking::Snapshot wanted = syntheticSnapshot(0.400);
  const auto row = history.at(0.4002);
  ASSERT_TRUE(row);
  EXPECT_DOUBLE_EQ(row->t, 0.400);
  EXPECT_FLOAT_EQ(row->joint[0].truth, static_cast<float>(base::toDegrees(wanted.q_link_true[0])));
  EXPECT_FLOAT_EQ(row->joint[1].kinematic, static_cast<float>(base::toDegrees(wanted.q_link_kin[1])));
  EXPECT_FLOAT_EQ(row->joint[2].ukf, static_cast<float>(1e3 * wanted.q_link_ukf[2]));
  EXPECT_FLOAT_EQ(row->joint[2].ukf_sigma, 0.6F);
}

TEST(JointHistory, AtGivesTheNearestRowAndTheEndsBeyond) {
  EXPECT_FALSE(JointHistory(16).at(0.0));
  const JointHistory history = filled(4096, 1000, 10);
  EXPECT_DOUBLE_EQ(history.at(-5.0)->t, 0.0);
  EXPECT_DOUBLE_EQ(history.at(0.504)->t, 0.50);
  EXPECT_DOUBLE_EQ(history.at(0.506)->t, 0.51);
  EXPECT_DOUBLE_EQ(history.at(50.0)->t, 0.99);
}

TEST(JointHistory, CameraAtKeepsToItsReach) {
  const JointHistory history = filled(4096, 1000);
  ASSERT_TRUE(history.cameraAt(0.130, 0.05));
  EXPECT_DOUBLE_EQ(history.cameraAt(0.130, 0.05)->t, 0.132);
  EXPECT_DOUBLE_EQ(history.cameraAt(0.070, 0.05)->t, 0.066);
  EXPECT_FALSE(history.cameraAt(0.099, 0.02)) << "between two exposures";
  EXPECT_FALSE(history.cameraAt(5.0, 0.1));
}

TEST(JointHistory, SameTimeReplacesAndEarlierIsIgnored) {
  JointHistory history = filled(64, 5);
  tracking::Snapshot late = syntheticSnapshot(0.004);
  late.q_link_kin[0] = 1.0;
  history.append(late);
  EXPECT_EQ(history.rows().size(), 5U);
  EXPECT_FLOAT_EQ(history.at(0.004)->joint[0].kinematic, static_cast<float>(base::toDegrees(1.0)));
  late.t = 0.002;
  late.q_link_kin[0] = 2.0;
  history.append(late);
  EXPECT_EQ(history.rows().size(), 5U);
  EXPECT_NE(history.at(0.002)->joint[0].kinematic, static_cast<float>(base::toDegrees(2.0)));
}

TEST(JointHistory, AClockSetBackBeginsItAnew) {
  JointHistory history = filled(16384, 9000);
  history.append(syntheticSnapshot(3.0));
  history.append(syntheticSnapshot(3.001));
  EXPECT_EQ(history.rows().size(), 2U);
  EXPECT_DOUBLE_EQ(history.begin(), 3.0);
  EXPECT_TRUE(history.occluded().empty());
}

TEST(JointHistory, OnlyALostMarkerIsOccluded) {
  using tracking::Gate;
  for (const auto& [gate, name] : base::NamesOf<Gate>::value) {
    JointHistory history(64);
    tracking::Snapshot snapshot = syntheticSnapshot(0.0);
    snapshot.gate = gate;
    history.append(snapshot);
    const bool lost = gate == Gate::kLeftLost || gate == Gate::kRightLost || gate == Gate::kBothLost;
    EXPECT_EQ(!history.occluded().empty(), lost) << name;
  }
}

TEST(JointHistory, EveryLevelOfThePyramidKeepsASpike) {
  JointHistory history(16384);
  for (int ms = 0; ms < 16000; ++ms) {
    tracking::Snapshot snapshot = syntheticSnapshot(ms * 1e-3);
    if (ms == 9137) snapshot.q_link_ukf[1] = 3.0;
    history.append(snapshot);
  }
  for (const std::size_t most : {20000U, 5000U, 1500U, 300U}) {
    float highest = 0.0F;
    std::size_t calls = 0;
    double last = -1.0;
    history.forEach(0.0, 16.0, most, [&](double t, double step, const auto&, const auto& high) {
      highest = std::fmax(highest, high[1].ukf);
      EXPECT_GT(t, last);
      EXPECT_GE(step, 0.0);
      last = t;
      ++calls;
    });
    EXPECT_FLOAT_EQ(highest, static_cast<float>(base::toDegrees(3.0))) << most;
    EXPECT_LE(calls, most);
    EXPECT_GT(calls, 0U);
  }
}

TEST(JointHistory, RingWrapsAndKeepsTheNewest) {
  const JointHistory history = filled(1000, 2500);
  EXPECT_EQ(history.rows().size(), 1000U);
  EXPECT_DOUBLE_EQ(history.begin(), 1.5);
  EXPECT_DOUBLE_EQ(history.end(), 2.499);
  EXPECT_DOUBLE_EQ(history.at(0.3)->t, 1.5);
  EXPECT_DOUBLE_EQ(history.at(2.0)->t, 2.0);
  int rows = 0;
  history.forEach(1.6, 1.7, 1000, [&](double, double step, const auto& low, const auto& high) {
    EXPECT_EQ(step, 0.0);
    EXPECT_EQ(low[0].truth, high[0].truth);
    ++rows;
  });
  EXPECT_NEAR(rows, 101, 2);
}

TEST(JointHistory, HoldsADayWithinItsMemory) {
  const JointHistory history;
  EXPECT_LE(history.bytes(), JointHistory::kBytes);
  EXPECT_GT(history.bytes(), JointHistory::kBytes * 9 / 10) << "the number that is stated is not the number";
}

/// 4,000 rows of which 256 are kept; the values are those of a ramp.
TEST(JointHistory, BlocksFollowWhatIsForgottenInOrderAndWithoutAGap) {
  MinMaxPyramid<JointHistory::Row> rows(256, 4096);
  for (int i = 0; i < 4000; ++i) {
    JointHistory::Row row;
    row.t = i;
    for (JointValues& values : row.joint) values = {1.0F * i, 2.0F * i, NAN, 0.0F};
    if (i % 7 == 0) row.joint[1].ukf = -5.0F;
    rows.push(row);
  }
  EXPECT_DOUBLE_EQ(rows.detailBegin(), 3744.0);
  EXPECT_LE(rows.begin(), 16.0);
  EXPECT_EQ(rows.blockAt(3800.0), 0.0);
  EXPECT_EQ(rows.blockAt(3743.0), 4.0);
  EXPECT_EQ(rows.blockAt(3700.0), 16.0);
  for (const auto& [begin, end, most] : {std::tuple{0.0, 4000.0, 5000U},
                                         {0.0, 4000.0, 300U},
                                         {3000.0, 3900.0, 5000U},
                                         {3700.0, 3800.0, 200U}}) {
    double last = -1.0, until = std::max(begin, rows.begin());
    std::size_t calls = 0;
    rows.forEach(begin, end, most, [&](double t, double step, const auto& low, const auto& high) {
      EXPECT_GT(t, last);
      EXPECT_TRUE(t <= begin || t > end || t - until <= 1.0) << "a gap before " << t;
      EXPECT_LE(low.joint[0].truth, static_cast<float>(t));
      EXPECT_GE(high.joint[0].truth, static_cast<float>(t + std::max(step - 1.0, 0.0)));
      EXPECT_TRUE(std::isnan(high.joint[1].ukf) || high.joint[1].ukf == -5.0F);
      last = t;
      until = t + step;
      ++calls;
    });
    EXPECT_LE(calls, most);
    EXPECT_GE(until, end - 2.0);
  }
}

TEST(JointHistory, OldOcclusionsAreThoseOfBlocks) {
  JointHistory history;
  tracking::Snapshot snapshot = syntheticSnapshot(0.0);
  for (int i = 0; i < 40'000; ++i) {  // 10,000 occlusions, more than are kept one by one
    snapshot.t = i;
    snapshot.gate = i % 4 == 3 ? tracking::Gate::kBothLost : tracking::Gate::kOpen;
    snapshot.camera_updated = false;
    history.append(snapshot);
  }
  std::vector<JointHistory::Span> spans;
  history.forEachOcclusion(0.0, 99.0, 500, [&](double begin, double end) { spans.push_back({begin, end}); });
  ASSERT_EQ(spans.size(), 25U);
  EXPECT_DOUBLE_EQ(spans[24].begin, 99.0);
  spans.clear();
  history.forEachOcclusion(0.0, 40'000.0, 500, [&](double begin, double end) {
    spans.push_back({begin, end});
  });
  EXPECT_EQ(spans.front().begin, 0.0);
  EXPECT_GT(spans.size(), JointHistory::kSpans) << "those that are kept, each";
  for (std::size_t i = 1; i < spans.size(); ++i) EXPECT_GE(spans[i].begin, spans[i - 1].end);
}

TEST(JointHistory, SpansOccludedTimeAndClears) {
  JointHistory history = filled(16384, 9000);
  ASSERT_EQ(history.occluded().size(), 1U);
  EXPECT_DOUBLE_EQ(history.occluded()[0].begin, 6.0);
  EXPECT_NEAR(history.occluded()[0].end, 8.0, 1e-9);
  for (std::size_t i = 0; i < history.camera().size(); ++i)
    EXPECT_TRUE(history.camera()[i].t < 6.0 || history.camera()[i].t >= 8.0);
  history.clear();
  EXPECT_TRUE(history.empty());
  EXPECT_TRUE(history.camera().empty());
  EXPECT_TRUE(history.occluded().empty());
}

}  // namespace
}  // namespace capstan::widgets
