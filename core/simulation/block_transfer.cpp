#include "core/simulation/block_transfer.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/yaml.h"

namespace capstan::simulation {
namespace {

constexpr int kBlocks = 6;
constexpr double kShortest = 80.0, kLongest = 290.0;  // duration of one whole task [s]
constexpr double kOneTransfer = 8.0;                  // shortest time of one transfer [s]
constexpr double kOrdinary = 600.0;        // longest duration that is checked at every dense step [s]
constexpr double kInstantsPerMove = 20.0;  // number of checks per move of a longer session

int transfersFor(double duration) {
  if (duration < kShortest) return std::max(1, static_cast<int>(2 * kBlocks * duration / kShortest));
  return 2 * kBlocks * static_cast<int>(std::ceil(duration / kLongest));
}

}  // namespace

Eigen::Vector3d PegBoard::peg(int index) const {
  const int place = index % kBlocks;
  const double side = index < kBlocks ? -1.0 : 1.0;
  const double across = place % 2 == 0 ? 0.020 : 0.038;
  const int row = place / 2 - 1;
  return centre + side * across * lateral + 0.022 * row * depth;
}

PegBoard pegBoard(const robot::Description& robot, const Eigen::Vector3d& on_board) {
  PegBoard board;
  board.centre = robot::ArmKinematics(robot).tip(on_board);
  board.up = -robot.gravity.normalized();
  board.lateral = Eigen::Vector3d::UnitZ();
  board.depth = board.up.cross(board.lateral).normalized();
  return board;
}

/// Draws the motion of one surgeon: first the waypoints, then the durations of moves and pauses.
class BlockTransfer::Planner {
 public:
  Planner(const PegBoard& board, std::uint64_t seed) : board_(board), random_(seed, "surgeon") {
    hover_ = random_.uniform(0.026, 0.034);
    grasp_ = random_.uniform(0.006, 0.010);
    handover_ = random_.uniform(0.032, 0.042);
    bow_ = random_.uniform(0.002, 0.006);
    unsteadiness_ = random_.uniform(0.05, 0.2);
    here_ = board_.centre + handover_ * board_.up;
  }

  void transfer(int from, int to) {
    const Eigen::Vector3d source = board_.peg(from) + scatter(0.001),
                          target = board_.peg(to) + scatter(0.001);
    const Eigen::Vector3d middle = board_.centre + handover_ * board_.up + scatter(0.006);
    move(source + hover_ * board_.up + scatter(0.002));
    move(source + grasp_ * board_.up);
    pause(0.5);
    move(source + handover_ * board_.up + scatter(0.003));
    move(middle);
    pause(1.0);
    move(target + hover_ * board_.up + scatter(0.002));
    move(target + grasp_ * board_.up);
    pause(0.4);
    move(target + hover_ * board_.up + scatter(0.002));
    if (random_.uniform(0.0, 1.0) < 0.3) pause(0.8);
  }

  void goHome() { move(board_.centre + handover_ * board_.up); }

  std::vector<int> order() {
    std::vector<int> pegs(kBlocks);
    std::iota(pegs.begin(), pegs.end(), 0);
    for (std::size_t i = pegs.size() - 1; i > 0; --i) std::swap(pegs[i], pegs[random_.bits() % (i + 1)]);
    return pegs;
  }

  /// Segments with their times. The moves take (1 − pause_share) of the duration, each by the square root of
  /// its length; the pauses take pause_share, each by its weight.
  std::vector<Segment> timed(double duration, double pause_share) {
    double moves = 0.0, pauses = 0.0;
    for (std::size_t i = 0; i < segments_.size(); ++i) (moving_[i] ? moves : pauses) += segments_[i].duration;
    double t = 0.0;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      segments_[i].duration *= duration * (moving_[i] ? (1.0 - pause_share) / moves : pause_share / pauses);
      segments_[i].start = t;
      t += segments_[i].duration;
    }
    return segments_;
  }

 private:
  Eigen::Vector3d scatter(double sigma) {
    Eigen::Vector3d drawn;
    for (double& value : drawn) value = sigma * std::clamp(random_.normal(), -2.0, 2.0);
    return drawn;
  }

  void move(const Eigen::Vector3d& to) {
    const double length = (to - here_).norm();
    const double weight =
        std::sqrt(length + 0.002) * std::exp(unsteadiness_ * std::clamp(random_.normal(), -2.0, 2.0));
    const Eigen::Vector3d bow = std::min(1.0, length / 0.05) * (bow_ * board_.up + scatter(0.3 * bow_));
    segments_.push_back({0.0, weight, here_, to, bow});
    moving_.push_back(true);
    here_ = to;
  }

  void pause(double weight) {
    weight *= std::exp(0.4 * std::clamp(random_.normal(), -2.0, 2.0));
    segments_.push_back({0.0, weight, here_, here_, Eigen::Vector3d::Zero()});
    moving_.push_back(false);
  }

  PegBoard board_;
  base::Random random_;
  double hover_, grasp_, handover_, bow_, unsteadiness_;
  Eigen::Vector3d here_;
  std::vector<Segment> segments_;
  std::vector<bool> moving_;
};

BlockTransfer::BlockTransfer(const BlockTransferSpec& spec, double duration, const robot::Description& robot,
                             std::uint64_t seed)
    : duration_(duration), transfers_(transfersFor(duration)), kinematics_(robot), near_(spec.board) {
  Planner planner(pegBoard(robot, spec.board), seed);
  std::vector<int> from, to;
  for (int i = 0; i < transfers_; ++i) {
    const auto place = static_cast<std::size_t>(i % kBlocks);
    const bool outward = i / kBlocks % 2 == 0;
    if (place == 0) {
      from = planner.order();
      to = planner.order();
    }
    planner.transfer(from[place] + (outward ? 0 : kBlocks), to[place] + (outward ? kBlocks : 0));
  }
  planner.goHome();
  segments_ = planner.timed(std::max(duration, kOneTransfer), spec.pause_share);

  base::Random random(seed, "tremor");
  for (auto& axis : tremor_)
    for (Tone& tone : axis)
      tone = {spec.tremor * random.uniform(0.2, 0.6), random.uniform(7.0, 11.0),
              random.uniform(0.0, 2.0 * std::numbers::pi)};
  requireReach();
}

/// Time along the planned path [s] and its rate [s/s]. A session shorter than one transfer ends before its
/// path does: it slows down to a halt.
std::pair<double, double> BlockTransfer::pathTime(double t) const {
  const double slowing = std::min(0.5, 0.5 * duration_), since = t - (duration_ - slowing);
  if (duration_ >= kOneTransfer || since <= 0.0) return {t, 1.0};
  return {t - 0.5 * since * since / slowing, 1.0 - since / slowing};
}

const BlockTransfer::Segment& BlockTransfer::segmentAt(double along) const {
  const auto after =
      std::upper_bound(segments_.begin(), segments_.end(), along,
                       [](double time, const Segment& segment) { return time < segment.start; });
  return *std::prev(after);
}

/// Steps of a session up to kOrdinary are dense enough to resolve the tremor. A longer session is checked at
/// kInstantsPerMove instants of each move: these meet the extremes of the move, and many phases of the
/// tremor.
double BlockTransfer::nextInstant(double t) const {
  if (duration_ <= kOrdinary) return t + kDenseStep;
  return t + std::max(kDenseStep, segmentAt(std::clamp(t, 0.0, duration_)).duration / kInstantsPerMove);
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> BlockTransfer::tipAt(double t) const {
  t = std::clamp(t, 0.0, duration_);
  const auto [along, pace] = pathTime(t);
  const Segment& segment = segmentAt(along);
  const auto [p, dp] = minimumJerk(along - segment.start, segment.duration);
  const Eigen::Vector3d way = segment.to - segment.from;
  Eigen::Vector3d position = segment.from + p * way + 4.0 * p * (1.0 - p) * segment.bow;
  Eigen::Vector3d velocity = pace * dp * (way + 4.0 * (1.0 - 2.0 * p) * segment.bow);

  const double edge = std::min(t, duration_ - t);  // tremor fades to zero at both ends
  const auto [gain, gain_rate] = minimumJerk(edge, std::min(1.0, 0.5 * duration_));
  const double signed_rate = t < 0.5 * duration_ ? gain_rate : -gain_rate;
  for (int axis = 0; axis < 3; ++axis)
    for (const Tone& tone : tremor_[static_cast<std::size_t>(axis)]) {
      const double omega = 2.0 * std::numbers::pi * tone.frequency, angle = omega * t + tone.phase;
      position[axis] += gain * tone.amplitude * std::sin(angle);
      velocity[axis] += tone.amplitude * (gain * omega * std::cos(angle) + signed_rate * std::sin(angle));
    }
  return {position, velocity};
}

JointTarget BlockTransfer::at(double t) const {
  const auto [tip, tip_velocity] = tipAt(t);
  const Eigen::Vector3d q = kinematics_.solvePosition(tip, near_).value_or(near_);
  return {q, kinematics_.tipJacobian(q).inverse() * tip_velocity};
}

void BlockTransfer::requireReach() const {
  constexpr double kGrid = 0.01;  // [s]
  for (double t = 0.0; t < duration_; t = std::max(t + kGrid, nextInstant(t))) {
    const auto q = kinematics_.solvePosition(tipAt(t).first, near_);
    if (q) continue;
    throw base::InputError({"trajectory", 0, "block_transfer",
                            base::yamlText(std::round(1e3 * t) / 1e3) + " s",
                            "the peg board is " + std::string(base::nameOf(q.error())),
                            "Use a robot file whose arm reaches its peg board"});
  }
}

}  // namespace capstan::simulation
