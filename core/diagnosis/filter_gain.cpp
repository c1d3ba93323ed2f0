#include "core/diagnosis/filter_gain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/base/parallel.h"
#include "core/base/progress_share.h"
#include "core/robot/chain/chain_model.h"
#include "core/stats/quantile.h"
#include "core/tracking/extended_arm_model.h"
#include "core/tracking/motor_reading.h"
#include "core/tracking/track_all.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Vector3d;

constexpr double kLongestMemory = 2.0;  // largest TrackingOptions::memory [s]

Vector3d rowOf(const Columns& columns, std::size_t row) {
  if (columns.empty()) return Vector3d::Constant(base::kNaN);
  return {columns[0][row], columns[1][row], columns[2][row]};
}

/// Source of the motor samples and tips of a recording, without its joint encoders.
class EvidenceSource {
 public:
  /// Observations are delivered `wait` after their stamp [s].
  EvidenceSource(const Evidence& evidence, double wait, base::Progress* progress)
      : evidence_(evidence), wait_(wait), progress_(progress) {}

  bool next(tracking::Sample& out) {
    if (row_ > 0 && nextObservation(row_ - 1, out)) return true;
    if (row_ == evidence_.rows() || (progress_ && progress_->cancelled())) return false;
    out = tracking::MotorSample{evidence_.t[row_], rowOf(evidence_.q_m, row_), rowOf(evidence_.dq_m, row_),
                                rowOf(evidence_.tau_m, row_)};
    ++row_;
    return true;
  }
  /// Row of the newest motor sample.
  std::size_t row() const { return row_ - 1; }

 private:
  /// Next observation, if it is known at `row`. The tolerance allows for different rounding of the times of
  /// rows and observations.
  bool nextObservation(std::size_t row, tracking::Sample& out) {
    if (observation_ == evidence_.tip.size()) return false;
    const TipObservation& observation = evidence_.tip[observation_];
    const double now = evidence_.t[row], known = observation.t + wait_;
    if (known > now + 1e-6 * evidence_.step) return false;
    out = tracking::TipSample{std::min(observation.t, now), std::min(known, now), observation.position};
    ++observation_;
    return true;
  }

  const Evidence& evidence_;
  double wait_;
  base::Progress* progress_;
  std::size_t row_ = 0, observation_ = 0;
};

/// Sums over the errors of one recording, one entry per joint.
struct ErrorSums {
  std::array<double, 3> count{}, sum{}, squares{};

  void add(const Vector3d& error) {
    for (int j = 0; j < 3; ++j) {
      if (!std::isfinite(error[j])) continue;
      const auto k = static_cast<std::size_t>(j);
      count[k] += 1.0, sum[k] += error[j], squares[k] += error[j] * error[j];
    }
  }
  double squaresOf(std::size_t j, bool about_mean) const {
    return about_mean && count[j] > 0.0 ? squares[j] - sum[j] * sum[j] / count[j] : squares[j];
  }
};

double delayOf(const robot::Description& robot) { return robot::ChainModel(robot).camera.delay; }

tracking::TrackingOptions optionsFor(const Evidence& evidence, const robot::Description& robot,
                                     tracking::TrackingOptions options) {
  std::vector<double> between;
  for (std::size_t i = 1; i < evidence.tip.size(); ++i)
    between.push_back(evidence.tip[i].t - evidence.tip[i - 1].t);
  if (!between.empty()) options.camera_period = std::max(stats::median(between), evidence.step);
  options.memory = std::min(options.memory + std::max(delayOf(robot), 0.0), kLongestMemory);
  return options;
}

ErrorSums errorsOf(const Evidence& evidence, const robot::Description& robot, double wait,
                   const tracking::TrackingOptions& options, base::Progress* progress) {
  tracking::TrackingPipeline pipeline(robot, std::nullopt, {}, optionsFor(evidence, robot, options));
  EvidenceSource source(evidence, wait, progress);
  ErrorSums sums;
  tracking::trackAll(source, pipeline, nullptr, 0.0,
                     [&](const tracking::Sample&, const tracking::Snapshot& snapshot) {
                       if (!snapshot.motor_updated || !evidence.counts(source.row())) return;
                       sums.add(snapshot.q_link_ukf - rowOf(evidence.q, source.row()));
                     });
  return sums;
}

double rmsOf(const std::vector<ErrorSums>& recordings, std::size_t joint, bool about_mean) {
  double squares = 0.0, count = 0.0;
  for (const ErrorSums& sums : recordings)
    squares += sums.squaresOf(joint, about_mean), count += sums.count[joint];
  return count > 0.0 ? std::sqrt(std::max(squares, 0.0) / count) : base::kNaN;
}

bool needsChainKernel(const robot::Description& robot) {
  return tracking::ExtendedArmModel::isNeededFor(tracking::MotorReading::undone(robot));
}

/// The same robots, all in the kernel of effects if one of them needs it. An effect of size 0 selects that
/// kernel.
std::array<robot::Description, 3> inOneKernel(std::array<robot::Description, 3> robots) {
  if (std::ranges::none_of(robots, needsChainKernel)) return robots;
  for (robot::Description& robot : robots)
    if (!needsChainKernel(robot)) robot.effects.push_back({"asymmetric_friction", 1, {{"share", 0.0}}});
  return robots;
}

/// Reason why the filter cannot follow this robot; empty: it can.
std::string refusal(const FilterRobots& robots) {
  const robot::Description& robot = robots.nominal;
  if (robot.drive != robot::DriveType::kCable) return "the filter is for cable-driven arms";
  if (robot.size() != 3)
    return fmt::format("the filter is for arms of three joints, this one has {}", robot.size());
  try {
    for (const robot::Description* one : {&robots.nominal, &robots.refitted, &robots.extended})
      tracking::TrackingPipeline(*one, std::nullopt, {}, {});
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

std::vector<const Evidence*> followed(const std::vector<Evidence>& recordings,
                                      std::vector<std::string>& notices) {
  std::vector<const Evidence*> kept;
  for (const Evidence& evidence : recordings) {
    if (evidence.hasEncoders() && evidence.hasCameras())
      kept.push_back(&evidence);
    else
      notices.push_back(fmt::format("{}: no {}; the Kalman filter is not compared on this recording",
                                    evidence.title, evidence.hasEncoders() ? "cameras" : "joint encoders"));
  }
  return kept;
}

/// Warnings of joints whose estimates the extended robot makes worse.
void noticeWorse(const std::vector<FilterGain>& joints, std::vector<std::string>& notices) {
  constexpr double kWorse = 1.05;  // less is no reason against a robot
  for (const FilterGain& one : joints)
    if (one.extended > kWorse * one.refitted)
      notices.push_back(fmt::format(
          "The Kalman filter's error of {} is {:.0f} % larger with the causes than with the refit alone: "
          "compare both on a trial before you use the extended robot",
          one.joint, 100.0 * (one.extended / one.refitted - 1.0)));
}

}  // namespace

FilterGainReport filterGain(const std::vector<Evidence>& recordings, const FilterRobots& robots,
                            const FilterGainOptions& options, base::Progress* progress) {
  FilterGainReport report;
  if (const std::string why = refusal(robots); !why.empty()) {
    report.notices.push_back("The Kalman filter is not compared with the encoders: " + why);
    return report;
  }
  const std::vector<const Evidence*> files = followed(recordings, report.notices);
  if (files.empty()) return report;
  std::array<robot::Description, 3> three = {robots.nominal, robots.refitted, robots.extended};
  if (options.one_kernel) three = inOneKernel(three);
  double wait = 0.0;
  for (const robot::Description& robot : three) wait = std::max(wait, -delayOf(robot));
  std::array<std::vector<ErrorSums>, 3> sums;
  for (std::vector<ErrorSums>& of : sums) of.resize(files.size());
  base::ProgressShare share(progress, 1.0, "Running the Kalman filter", 3 * files.size());
  base::parallelFor(3 * files.size(), options.threads, [&](std::size_t task) {
    const std::size_t robot = task % 3, file = task / 3;
    sums[robot][file] = errorsOf(*files[file], three[robot], wait, options.tracking, progress);
    share.finished();
  });
  report.cancelled = progress && progress->cancelled();
  if (report.cancelled) return report;
  for (std::size_t j = 0; j < 3; ++j) {
    const auto rms = [&](std::size_t robot) { return rmsOf(sums[robot], j, options.zero_per_recording); };
    const bool slides = robots.nominal.joints[j].type == robot::JointType::kPrismatic;
    report.joints.push_back({fmt::format("q{}", j + 1), slides ? "m" : "rad", rms(0), rms(1), rms(2)});
  }
  noticeWorse(report.joints, report.notices);
  return report;
}

}  // namespace capstan::diagnosis
