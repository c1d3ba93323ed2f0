#include "tests/support/planted/excitation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::test {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

Excitation::Excitation(const robot::Description& robot, double duration, base::Random& random) {
  for (const robot::Joint& joint : robot.joints) {
    const bool turns = joint.type == robot::JointType::kRevolute;
    const double range = joint.limit_high - joint.limit_low, speed = 0.85 * joint.max_speed;
    const double sway = 0.08 * range;
    const double low = joint.limit_low + (turns ? 0.12 : 0.10) * range;
    const double high = joint.limit_low + (turns ? 0.87 : 0.50) * range;
    Axis axis;
    axis.start = random.uniform(low + sway, high - sway);
    addMoves(axis, low + sway, high - sway, 0.7 * speed, duration, random);
    addSwells(axis, sway, 0.3 * speed, duration, random);
    axes_.push_back(std::move(axis));
  }
}

void Excitation::addMoves(Axis& axis, double low, double high, double speed, double duration,
                          base::Random& random) {
  const double range = high - low;
  double at = axis.start, t = random.uniform(0.2, 0.8), way = 1.0;
  while (t < duration) {
    const bool back = random.uniform(0.0, 1.0) < 0.5;  // a short move against the one before
    const double step = random.uniform(0.03, 0.2) * range;
    double to = back ? at - way * step : random.uniform(low, high);
    to = std::clamp(to, low, high);
    if (std::abs(to - at) < 0.01 * range) to = at > low + 0.5 * range ? at - step : at + step;
    const double distance = std::abs(to - at);
    const double fastest = speed * std::exp(random.uniform(std::log(0.15), 0.0));
    const double time =
        std::max({1.875 * distance / fastest, std::sqrt(5.78 * distance / (6.0 * speed)), 0.15});
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
      const double f = std::exp(random.uniform(std::log(0.3), std::log(2.5)));
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
