#include "core/tracking/residual_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kAtRest = Vector3d::Zero();

TEST(WhiteNoise, IsMeasuredWhateverDriftsBeside) {
  base::Random random(5, "white");
  WhiteNoise noise(3000, 0.1, 1e-3);
  const Matrix3d stated = 25.0 * Matrix3d::Identity();
  const Vector3d sigma(0.2, 0.3, 2.0);
  for (int k = 0; k < 6000; ++k) {
    const double t = k / 15.0;
    const Vector3d drift(5.0 * std::sin(0.3 * t), 0.1 * t, -3.0);
    Vector3d residual = drift;
    for (int i = 0; i < 3; ++i) residual(i) += random.normal(0.0, sigma(i));
    noise.add(t, residual, kAtRest, stated);
  }
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(std::sqrt(noise.value(stated, kAtRest)(i, i)), sigma(i), 0.06 * sigma(i)) << i;
}

TEST(WhiteNoise, KeepsWhatIsStatedUntilEnoughNeighboursWereSeen) {
  WhiteNoise noise(100, 0.1, 1e-3);
  const Matrix3d stated = 4.0 * Matrix3d::Identity();
  base::Random random(9, "neighbours");
  const auto add = [&](double t) { noise.add(t, Vector3d(random.normal(), 0.0, 0.0), kAtRest, stated); };
  for (int k = 0; k < 200; ++k) add(1.0 * k);  // gaps: no neighbours
  EXPECT_EQ(noise.value(stated, kAtRest), stated);
  for (int k = 0; k < WhiteNoise::kEnough + 1; ++k) add(300.0 + 0.05 * k);
  EXPECT_EQ(noise.value(stated, kAtRest), stated);
  add(300.0 + 0.05 * (WhiteNoise::kEnough + 1));
  EXPECT_NE(noise.value(stated, kAtRest), stated);
}

TEST(WhiteNoise, WithoutMemoryIsWhatIsStated) {
  WhiteNoise noise(0, 0.1, 1e-3);
  const Matrix3d stated = 4.0 * Matrix3d::Identity();
  for (int k = 0; k < 100; ++k) noise.add(0.05 * k, Vector3d(k % 2, 0.0, 0.0), kAtRest, stated);
  EXPECT_EQ(noise.value(stated, kAtRest), stated);
}

/// Noise of a residual whose stamps have a noise too, of an arm that rests and moves in turn.
double clockSigmaFound(double clock, double measurement, WhiteNoise noise) {
  base::Random random(11, "stamps");
  for (int k = 0; k < 2700; ++k) {
    const double t = k / 30.0;
    const bool rests = k / 30 % 3 == 0;
    const Vector3d speed =
        rests ? kAtRest : Vector3d(0.05 * std::cos(2.0 * t), 0.03 * std::sin(3.0 * t), 0.01);
    Vector3d residual = random.normal(0.0, clock) * speed;
    for (int i = 0; i < 3; ++i) residual(i) += random.normal(0.0, measurement);
    noise.add(t, residual, speed, 1e-8 * Matrix3d::Identity());
  }
  EXPECT_NEAR(std::sqrt(noise.value(1e-8 * Matrix3d::Identity(), kAtRest)(0, 0)), measurement,
              0.1 * measurement);
  return noise.clockSigma();
}

TEST(WhiteNoise, OfTheTimeStampsIsDistinguishedFromThatOfTheMeasurement) {
  EXPECT_NEAR(clockSigmaFound(0.015, 5e-5, WhiteNoise(3000, 0.1, 1e-3)), 0.015, 0.0015);
  EXPECT_NEAR(clockSigmaFound(0.003, 5e-5, WhiteNoise(3000, 0.1, 1e-3)), 0.003, 0.0004);
  EXPECT_LT(clockSigmaFound(0.0, 5e-5, WhiteNoise(3000, 0.1, 1e-3)), 5e-4);
}

TEST(WhiteNoise, OfTheTimeStampsStaysZeroWhereItIsStatedSo) {
  EXPECT_EQ(clockSigmaFound(0.0, 5e-5, WhiteNoise(3000, 0.1, 0.0)), 0.0);
}

TEST(WhiteNoise, ResetForgetsWhatWasMeasured) {
  WhiteNoise noise(3000, 0.1, 1e-3);
  base::Random random(13, "reset");
  const Vector3d speed(0.05, 0.0, 0.0);
  for (int k = 0; k < 300; ++k)
    noise.add(
        k / 30.0,
        random.normal(0.0, 0.02) * speed + 1e-5 * Vector3d(random.normal(), random.normal(), random.normal()),
        speed, 1e-8 * Matrix3d::Identity());
  EXPECT_GT(noise.clockSigma(), 0.01);
  noise.reset();
  EXPECT_DOUBLE_EQ(noise.clockSigma(), 1e-3);
  EXPECT_EQ(noise.value(4.0 * Matrix3d::Identity(), kAtRest), 4.0 * Matrix3d::Identity());
}

TEST(WhiteNoise, OfTheTimeStampsIsAsStatedUntilSomethingMoves) {
  WhiteNoise noise(3000, 0.1, 4e-3);
  base::Random random(12, "stamps at rest");
  for (int k = 0; k < 100; ++k)
    noise.add(k / 30.0, Vector3d(random.normal(), random.normal(), random.normal()), kAtRest,
              Matrix3d::Identity());
  EXPECT_DOUBLE_EQ(noise.clockSigma(), 4e-3);
}

TEST(StatedShare, FallsToWhatIsSeenAndNeverRisesAboveWhatIsStated) {
  base::Random random(7, "share");
  const auto mean = [&](double true_variance) {
    StatedShare share;
    double sum = 0.0;
    for (int k = 0; k < 5000; ++k) {
      const double nis = std::pow(random.normal(0.0, std::sqrt(true_variance)), 2) / share.value();
      if (k >= 1000) sum += nis / 4000.0;
      share.add(nis);
    }
    return sum;
  };
  EXPECT_NEAR(mean(0.1), 1.0, 0.1);
  EXPECT_NEAR(mean(0.01), 1.0, 0.1);
  EXPECT_NEAR(mean(3.0), 3.0, 0.3) << "a filter that is wrong stays so";
}

}  // namespace
}  // namespace capstan::tracking
