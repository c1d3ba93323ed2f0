#include "core/estimation/delayed_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "tests/support/counting_new.h"

namespace capstan::estimation {
namespace {

using Position = LinearMeasurement<2, 1>;
using Output = Eigen::Matrix<double, 1, 1>;

/// A driven pendulum; the control is a torque, linear between samples.
struct Pendulum {
  static constexpr int kStates = 2;
  using Control = double;
  struct Input {
    double start = 0.0, end = 0.0;
  };
  static Input interval(const Control& a, const Control& b) { return {a, b}; }
  static Control between(const Control& a, const Control& b, double fraction) {
    return a + fraction * (b - a);
  }
  void propagate(SigmaPoints<2>& x, const Input& u, double dt) const {
    for (int c = 0; c < x.cols(); ++c) {
      const double speed = x(1, c) + dt * (0.5 * (u.start + u.end) - 3.0 * std::sin(x(0, c)));
      x(0, c) += dt * 0.5 * (x(1, c) + speed);
      x(1, c) = speed;
    }
  }
};

using Filter = DelayedFilter<Pendulum, Position>;

Position position() {
  Position p;
  p.h(0, 0) = 1.0;
  return p;
}
Lower<2> density() {
  Lower<2> d = Lower<2>::Zero();
  d.diagonal() << 0.01, 0.2;
  return d;
}
Lower<1> sigma() { return Lower<1>(0.05); }
double controlAt(double t) { return std::sin(3.0 * t) + 0.3; }
double measuredAt(double t) { return 0.4 * std::sin(2.0 * t) + 0.05 * std::sin(171.0 * t); }

struct Event {
  double t, arrival;
  bool control;
};

/// Controls every 10 ms, measurements at odd times.
std::vector<Event> events(double lag, double jitter) {
  base::Random random(11);
  std::vector<Event> list;
  for (int k = 1; k <= 300; ++k) list.push_back({0.01 * k, 0.01 * k, true});
  for (int k = 1; k <= 60; ++k) {
    const double t = 0.0471 * k;
    list.push_back({t, t + lag + random.uniform(0.0, jitter), false});
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
  return list;
}

Filter started() {
  Filter filter(Pendulum{}, density(), 400);
  filter.reset(0.0, {0.1, 0.0}, Lower<2>(0.3 * Lower<2>::Identity()), controlAt(0.0));
  return filter;
}

void take(Filter& filter, const Event& event) {
  if (event.control)
    EXPECT_TRUE(filter.advance(event.t, controlAt(event.t)));
  else
    EXPECT_TRUE(filter.update(event.t, position(), Output(measuredAt(event.t)), sigma()).has_value());
}

/// The same by hand: a plain filter that meets every event at its time, controls interpolated between
/// samples.
SquareRootUkf<2> inOrderOfTime() {
  std::vector<Event> list = events(0.0, 0.0);
  std::stable_sort(list.begin(), list.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
  SquareRootUkf<2> filter;
  filter.reset({0.1, 0.0}, Lower<2>(0.3 * Lower<2>::Identity()));
  const auto control = [](double t) {
    const double left = std::floor(t / 0.01 + 1e-9), fraction = t / 0.01 - left;
    return controlAt(0.01 * left) + fraction * (controlAt(0.01 * (left + 1)) - controlAt(0.01 * left));
  };
  double before = 0.0;
  for (const Event& event : list) {
    const double dt = event.t - before;
    if (dt > 0.0)
      filter.predict(Pendulum{}, {control(before), control(event.t)}, dt,
                     Lower<2>(density() * std::sqrt(dt)));
    if (!event.control) filter.update(position(), Output(measuredAt(event.t)), sigma());
    before = event.t;
  }
  return filter;
}

TEST(DelayedFilter, LateIsTheSameAsInOrder) {
  const SquareRootUkf<2> expected = inOrderOfTime();
  for (const auto& [lag, jitter] : {std::pair{0.0, 0.0}, {0.042, 0.0}, {0.03, 0.2}, {0.5, 1.0}}) {
    Filter filter = started();
    for (const Event& event : events(lag, jitter)) take(filter, event);
    EXPECT_DOUBLE_EQ(filter.time(), 3.0);
    EXPECT_LT((filter.mean() - expected.mean()).norm(), 1e-12) << lag;
    EXPECT_LT((filter.covariance() - expected.covariance()).norm(), 1e-12) << lag;
  }
}

TEST(DelayedFilter, ReportIsThatOfTheMeasurementsOwnTime) {
  Filter prompt = started(), late = started();
  for (int k = 1; k <= 20; ++k) prompt.advance(0.01 * k, controlAt(0.01 * k));
  for (int k = 1; k <= 60; ++k) late.advance(0.01 * k, controlAt(0.01 * k));
  const auto ahead = late.peek(0.2, position(), Output(0.5), sigma());
  const auto then = late.update(0.2, position(), Output(0.5), sigma());
  const auto now = prompt.update(0.2, position(), Output(0.5), sigma());
  ASSERT_TRUE(ahead && then && now);
  EXPECT_EQ(ahead->nis, now->nis);
  EXPECT_EQ(then->nis, now->nis);
  const auto back = late.at(0.2);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ((*back)->mean(), prompt.mean());
}

TEST(DelayedFilter, SaysWhenItCannot) {
  Filter filter(Pendulum{}, density(), 8);
  EXPECT_EQ(filter.update(0.0, position(), Output(0.0), sigma()).error(), LateFault::kNotStarted);
  EXPECT_FALSE(filter.advance(0.1, 0.0));
  filter.reset(1.0, {0.0, 0.0}, Lower<2>(Lower<2>::Identity()), 0.0);
  EXPECT_EQ(filter.update(0.9, position(), Output(0.0), sigma()).error(), LateFault::kTooOld);
  EXPECT_FALSE(filter.advance(1.0, 0.0));
  for (int k = 1; k <= 20; ++k) EXPECT_TRUE(filter.advance(1.0 + 0.01 * k, 0.0));
  EXPECT_EQ(filter.update(1.12, position(), Output(0.0), sigma()).error(), LateFault::kTooOld);
  const Eigen::Vector2d before = filter.mean();
  EXPECT_TRUE(filter.update(1.15, position(), Output(1.0), sigma()).has_value());
  EXPECT_NE(filter.mean(), before);
}

TEST(DelayedFilter, SurvivesMoreEarlyMeasurementsThanItsMemory) {
  Filter filter(Pendulum{}, density(), 8);
  filter.reset(0.0, {0.0, 0.0}, Lower<2>(Lower<2>::Identity()), 0.0);
  for (int k = 1; k <= 40; ++k) {
    const auto report = filter.update(0.01 * k, position(), Output(0.1), sigma());
    EXPECT_TRUE(report.has_value() && report->applied);
  }
  EXPECT_TRUE(filter.advance(0.5, 0.0));
  EXPECT_TRUE(filter.mean().allFinite());
}

TEST(DelayedFilter, AllocatesNothing) {
  Filter filter = started();
  const std::vector<Event> list = events(0.042, 0.01);
  const std::size_t before = test::allocations();
  for (const Event& event : list) take(filter, event);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace capstan::estimation
