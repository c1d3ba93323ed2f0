#include "tests/support/planted/excitation.h"

#include <algorithm>
#include <cmath>

#include "tests/support/planted/log_uniform.h"
#include "tests/support/planted/turn.h"

namespace capstan::test {
namespace {

/// Time of a smoothStep() over `distance` at a peak speed of at most `fastest`, and with no more acceleration
/// than is used to reach `speed` [s].
double moveTime(double distance, double fastest, double speed) {
  return std::max({1.875 * distance / fastest, std::sqrt(5.78 * distance / (6.0 * speed)), 0.15});
}

}  // namespace

double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

Excitation::Excitation(const robot::Description& robot, double duration, base::Random& random,
                       MotionStyle style) {
  for (const robot::Joint& joint : robot.joints) {
    const bool turns = joint.type == robot::JointType::kRevolute;
    const double range = joint.limit_high - joint.limit_low, speed = 0.85 * joint.max_speed;
    const double sway = 0.08 * range;
    const double low = joint.limit_low + (turns ? 0.12 : 0.10) * range;
    const double high = joint.limit_low + (turns ? 0.87 : 0.50) * range;
    Axis axis;
    axis.low = low + sway;
    axis.high = high - sway;
    axis.speed = 0.7 * speed;
    axis.start = random.uniform(axis.low, axis.high);
    if (style == MotionStyle::kMoves) {
      addMoves(axis, duration, random);
      addSwells(axis, sway, 0.3 * speed, duration, random);
    }
    if (style == MotionStyle::kMultisine) addMultisine(axis, duration, random);
    axes_.push_back(std::move(axis));
  }
  if (style == MotionStyle::kTransfer) addTransfer(duration, random);
  if (style == MotionStyle::kSweeps) addSweeps(duration, random);
}

void Excitation::addTransfer(double duration, base::Random& random) {
  const std::size_t poses = 3 + random.bits() % 3;
  std::vector<std::vector<double>> stations(poses);
  for (auto& station : stations)
    for (const Axis& axis : axes_) station.push_back(random.uniform(axis.low, axis.high));
  std::vector<double> at;
  for (const Axis& axis : axes_) at.push_back(axis.start);
  double t = random.uniform(0.2, 0.8);
  for (std::size_t k = 0; t < duration; ++k) {
    const std::vector<double>& to = stations[k % poses];
    const double share = logUniform(random, 0.2, 1.0);  // of the highest speed
    double time = 0.0;
    for (std::size_t i = 0; i < axes_.size(); ++i)
      time = std::max(time, moveTime(std::abs(to[i] - at[i]), share * axes_[i].speed, axes_[i].speed));
    for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].moves.push_back({t, t + time, at[i], to[i]});
    at = to;
    t += time + random.uniform(0.2, 1.2);
  }
}

void Excitation::addSweeps(double duration, base::Random& random) {
  std::vector<double> at;
  for (const Axis& axis : axes_) at.push_back(axis.start);
  double t = random.uniform(0.2, 0.8);
  for (std::size_t k = 0; t < duration; ++k) {
    const std::size_t i = k % axes_.size();
    const double to = random.uniform(axes_[i].low, axes_[i].high), speed = axes_[i].speed;
    const double time = moveTime(std::abs(to - at[i]), speed * logUniform(random, 0.3, 1.0), speed);
    axes_[i].moves.push_back({t, t + time, at[i], to});
    at[i] = to;
    t += time + random.uniform(0.0, 0.3);
  }
}

/// The axis starts in the middle of its range, so that the sines of all phases stay inside.
void Excitation::addMultisine(Axis& axis, double duration, base::Random& random) {
  constexpr int kSines = 5;
  axis.start = 0.5 * (axis.low + axis.high);
  Swell swell{0.0, duration + 1.0, {}};
  for (int k = 0; k < kSines; ++k) {
    const double f = logUniform(random, 0.05, 1.5);
    const double most = std::min(0.5 * (axis.high - axis.low), axis.speed / (kTurn * f)) / kSines;
    swell.sines.push_back({most * random.uniform(0.5, 1.0), f, random.uniform(0.0, kTurn)});
  }
  axis.swells.push_back(std::move(swell));
}

void Excitation::addMoves(Axis& axis, double duration, base::Random& random) {
  const double low = axis.low, high = axis.high, range = high - low;
  double at = axis.start, t = random.uniform(0.2, 0.8), way = 1.0;
  while (t < duration) {
    const bool back = random.uniform(0.0, 1.0) < 0.5;  // a short move against the one before
    const double step = random.uniform(0.03, 0.2) * range;
    double to = back ? at - way * step : random.uniform(low, high);
    to = std::clamp(to, low, high);
    if (std::abs(to - at) < 0.01 * range) to = at > low + 0.5 * range ? at - step : at + step;
    const double fastest = axis.speed * logUniform(random, 0.15, 1.0);
    const double time = moveTime(std::abs(to - at), fastest, axis.speed);
    axis.moves.push_back({t, t + time, at, to});
    way = to > at ? 1.0 : -1.0;
    at = to;
    t += time + (random.uniform(0.0, 1.0) < 0.4 ? random.uniform(0.3, 1.3) : random.uniform(0.0, 0.1));
  }
}

void Excitation::addSwells(Axis& axis, double amplitude, double speed, double duration,
                           base::Random& random) {
  double t = random.uniform(0.5, 3.0);
  while (t < duration) {
    Swell swell{t, t + random.uniform(4.0, 8.0), {}};
    for (int k = 0; k < 3; ++k) {
      const double f = logUniform(random, 0.3, 2.5);
      const double most = std::min(amplitude, speed / (kTurn * f)) / 3.0;
      swell.sines.push_back({most * random.uniform(0.4, 1.0), f, random.uniform(0.0, kTurn)});
    }
    axis.swells.push_back(std::move(swell));
    t = axis.swells.back().end + random.uniform(0.5, 3.0);
  }
}

Joints Excitation::at(double t) const {
  Joints q{};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    q[i] = axis.start;
    const auto next = std::upper_bound(axis.moves.begin(), axis.moves.end(), t,
                                       [](double time, const Move& move) { return time < move.begin; });
    if (next != axis.moves.begin()) {
      const Move& move = *std::prev(next);
      q[i] = move.from + (move.to - move.from) * smoothStep((t - move.begin) / (move.end - move.begin));
    }
    for (const Swell& swell : axis.swells) {
      if (t < swell.begin || t > swell.end) continue;
      const double loud = smoothStep((t - swell.begin) / 0.8) * smoothStep((swell.end - t) / 0.8);
      for (const Sine& sine : swell.sines)
        q[i] += loud * sine.amplitude * std::sin(kTurn * sine.frequency * t + sine.phase);
    }
  }
  return q;
}

ExternalLoad::ExternalLoad(const Joints& amplitude, base::Random& random) : amplitude_(amplitude) {
  for (int i = 0; i < kMostJoints; ++i)
    for (int k = 0; k < 2; ++k) {
      frequency_[k][i] = random.uniform(0.06, 0.3);
      phase_[k][i] = random.uniform(0.0, kTurn);
    }
}

Joints ExternalLoad::at(double t) const {
  Joints load{};
  for (int i = 0; i < kMostJoints; ++i)
    load[i] = amplitude_[i] * (0.65 * std::sin(kTurn * frequency_[0][i] * t + phase_[0][i]) +
                               0.35 * std::sin(kTurn * frequency_[1][i] * t + phase_[1][i]));
  return load;
}

}  // namespace capstan::test
