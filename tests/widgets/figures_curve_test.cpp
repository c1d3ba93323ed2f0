#include <gtest/gtest.h>

#include <cmath>

#include "widgets/figures/curve.h"

namespace capstan::widgets {
namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(CurveBuilder, TakesOnePointOfARowAndTwoOfABucketAlongTheSlope) {
  CurveBuilder curve;
  curve.begin();
  curve.add(0.0, 1.0, 3.0F, 3.0F);
  curve.add(1.0, 1.0, 4.0F, 6.0F);
  curve.add(2.0, 1.0, 0.0F, 2.0F);
  const auto& points = curve.points();
  ASSERT_EQ(points.size(), 5);
  EXPECT_EQ(points[0].value, 3.0);
  EXPECT_EQ(points[1].value, 4.0) << "rising: low first";
  EXPECT_EQ(points[2].value, 6.0);
  EXPECT_EQ(points[3].value, 2.0) << "falling: high first";
  EXPECT_EQ(points[4].value, 0.0);
  for (int i = 1; i < points.size(); ++i) EXPECT_GT(points[i].key, points[i - 1].key);
  curve.begin();
  EXPECT_TRUE(curve.points().isEmpty());
}

TEST(CurveBuilder, TurnsTheFirstBucketWhenTheCurveFalls) {
  CurveBuilder curve;
  curve.begin();
  curve.add(0.0, 1.0, 8.0F, 9.0F);
  curve.add(1.0, 1.0, 6.0F, 7.0F);
  const auto& points = curve.points();
  ASSERT_EQ(points.size(), 4);
  for (int i = 1; i < 4; ++i) EXPECT_LT(points[i].value, points[i - 1].value);
}

TEST(CurveBuilder, KeepsAGapAsOne) {
  CurveBuilder curve;
  curve.begin();
  curve.add(0.0, 1.0, 1.0F, 1.0F);
  curve.add(1.0, 1.0, kNan, kNan);
  ASSERT_EQ(curve.points().size(), 2);
  EXPECT_TRUE(std::isnan(curve.points()[1].value));
}

/// Share of [0, 10] that the pieces between gaps cover.
double drawnLength(const QVector<QCPGraphData>& dashed) {
  double sum = 0.0;
  for (int i = 1; i < dashed.size(); ++i)
    if (!std::isnan(dashed[i].value) && !std::isnan(dashed[i - 1].value))
      sum += dashed[i].key - dashed[i - 1].key;
  return sum;
}

TEST(CutDashes, DrawsItsShareOnTheLineAndStaysInPlace) {
  QVector<QCPGraphData> line, dashed;
  for (int i = 0; i <= 37; ++i) line.append({i * 10.0 / 37, 2.0 * (i * 10.0 / 37) + 1.0});
  DashCutter(1.0, 0.6, 1e9).cut(line, dashed);
  EXPECT_NEAR(drawnLength(dashed), 6.0, 1e-9);
  for (const auto& point : dashed) {
    if (std::isnan(point.value)) continue;
    EXPECT_NEAR(point.value, 2.0 * point.key + 1.0, 1e-9);
    const double phase = std::fmod(point.key + 1e-9, 1.0);
    EXPECT_LE(phase, 0.6 + 2e-9) << "dashes begin at whole seconds, wherever the curve's points are";
  }
}

TEST(CutDashes, NoGapHidesASpike) {
  for (double at = 3.0; at < 5.0; at += 0.1) {
    QVector<QCPGraphData> line{{0.0, 1.0}, {at - 0.01, 1.0}, {at, 9.0}, {at + 0.01, 1.0}, {8.0, 1.0}}, dashed;
    DashCutter(1.0, 0.6, 2.0).cut(line, dashed);
    double highest = 0.0;
    for (const auto& point : dashed) highest = std::fmax(highest, point.value);
    EXPECT_EQ(highest, 9.0) << "at " << at;
    EXPECT_LT(drawnLength(dashed), 5.0) << "and the rest stays dashed";
  }
}

TEST(CutDashes, BridgesNoGap) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  QVector<QCPGraphData> line{{0.0, 1.0}, {1.0, nan}, {2.0, nan}, {3.0, 1.0}, {4.0, 1.0}}, dashed;
  DashCutter(0.5, 0.25, 1e9).cut(line, dashed);
  EXPECT_NEAR(drawnLength(dashed), 0.5, 1e-9);
  for (const auto& point : dashed) EXPECT_TRUE(std::isnan(point.value) || point.key >= 3.0) << point.key;
}

}  // namespace
}  // namespace capstan::widgets
