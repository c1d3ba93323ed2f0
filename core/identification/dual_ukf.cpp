#include "core/identification/dual_ukf.h"

#include <Eigen/Cholesky>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/identification/identifiability.h"
#include "core/identification/output_error.h"
#include "core/identification/parameter_filter.h"
#include "core/identification/score_spread.h"
#include "core/robot/transmission.h"

namespace capstan::identification {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using State = tracking::CableArmModel::State;

constexpr double kLongestInterval = 0.25;                   // longest propagation between updates of Φ [s]
constexpr double kStartPosition = 0.05, kStartSpeed = 0.1;  // σ of the first state [rad or m; per second]
/// Process noise of the states [rad/√s, rad/√s, m/√s] and [rad/s/√s, rad/s/√s, m/s/√s]. It is small: speed
/// noise of the size of v_eps would average the friction law, and the filter would estimate twice the
/// friction.
const Vector3d kPositionNoise{1e-4, 1e-4, 1e-5}, kVelocityNoise{0.01, 0.01, 0.001};
constexpr double kMemoryShare = 0.5;     // memory of r_k in (11), as a share of the elapsed time
constexpr double kShortestMemory = 5.0;  // shortest memory of r_k [s]
constexpr double kScoreMemory = 60.0;    // memory of the correlation of innovations [s]
constexpr double kTracePeriod = 0.5;     // time between points of the trace [s]

/// h(x): tip position measured by the camera of `pose`.
struct TipMeasurement {
  static constexpr int kOutputs = 3;
  const robot::ArmKinematics& arm;
  const CameraPose& pose;
  const Vector3d& centre;

  void observe(const estimation::SigmaPoints<6>& points, estimation::OutputPoints<6, 3>& outputs) const {
    for (Eigen::Index k = 0; k < points.cols(); ++k) {
      const Vector3d q(points(0, k), points(2, k), points(4, k)),
          dq(points(1, k), points(3, k), points(5, k));
      outputs.col(k) = pose.seen(arm.tip(q - pose.delay * dq), centre);
    }
  }
};

/// Sums for Visibility, accumulated while the filter runs.
struct Tally {
  /// Information on each unknown alone.
  ParameterFilter::Unknowns information = ParameterFilter::Unknowns::Zero();
  Eigen::Matrix<double, 3, kMostParameters> moved = Eigen::Matrix<double, 3, kMostParameters>::Zero();
  Vector3d noise = Vector3d::Zero();

  void add(const ParameterFilter::Innovation& innovation, const ParameterFilter::Sensitivity& by_log,
           const CameraObservation& seen) {
    const Matrix3d inverse = innovation.noise_covariance.llt().solve(Matrix3d::Identity());
    for (Eigen::Index i = 0; i < information.size(); ++i)
      information(i) += innovation.by_unknown.col(i).dot(inverse * innovation.by_unknown.col(i));
    for (Eigen::Index joint = 0; joint < 3; ++joint) moved.row(joint) += by_log.row(2 * joint).cwiseAbs2();
    noise += seen.q_covariance.diagonal();
  }
  Visibility of(const Parameter& parameter, int i, int count) const {
    Visibility v;
    v.sigma_alone = parameter.prior_sigma / std::sqrt(1.0 + information(i));
    v.moved = parameter.prior_sigma * std::sqrt(moved(parameter.joint, i) / std::max(1, count));
    v.noise = std::sqrt(noise(parameter.joint) / std::max(1, count));
    return v;
  }
};

/// Both filters and their position in the recording.
class Dual {
 public:
  Dual(const IdentificationData& data, const ParameterSet& set, const DualUkfOptions& options)
      : data_(data),
        set_(set),
        options_(options),
        arm_(data.robot),
        model_(data.robot),
        centre_(centreOf(data)),
        parameters_(set, arm_, options.camera, centre_),
        spread_(kCorrelationBlock, ModelDiscrepancy::kMemory, kScoreMemory) {
    start(0);
    last_ = t_;
  }

  /// Advances to `t` in intervals of at most kLongestInterval.
  void advanceTo(double t) {
    const MotorTrack& motors = data_.motors;
    while (t_ < t) {
      interval_.steps.clear();
      const double end = std::min(t, t_ + kLongestInterval);
      const State from = states_.mean();
      while (t_ < end) {
        const std::size_t next = std::min(at_ + 1, motors.size() - 1);
        if (next == at_) return;
        if (motors.t[next] - motors.t[at_] > kMotorGap) {
          start(next);
          if (t_ >= t) return;
          break;
        }
        step(std::min(end, motors.t[next]));
        if (t_ >= motors.t[next]) at_ = next;
      }
      if (!interval_.steps.empty()) parameters_.propagate(from, interval_);
    }
  }

  /// Updates both filters. If an absurd motor reading has left no finite state, restarts from the newest
  /// reading.
  void take(const CameraObservation& seen) {
    if (!states_.mean().allFinite() || !states_.squareRoot().allFinite() ||
        !parameters_.sensitivity().allFinite())
      return start(at_);
    const CameraPose before = parameters_.pose();
    const Eigen::Matrix<double, 3, 6> by_state = tipByState(before);
    const Eigen::Matrix<double, 6, 6> covariance = states_.covariance();
    const Matrix3d noise = by_state * covariance * by_state.transpose();
    const ParameterSet::Logs old = parameters_.logs();
    const auto innovation = parameters_.update(seen, noise, kHuberLimit);
    spread_.add(seen.t, innovation, tipByDiscrepancy(old));
    tally_.add(innovation, parameters_.sensitivity(), seen);
    nis_ += innovation.nis / 3.0;
    held_back_ += innovation.weight < 1.0 ? 1 : 0;
    ++count_;
    const double along = seen.t - data_.motors.t.front();
    parameters_.forget(std::max(kShortestMemory, kMemoryShare * along), seen.t - last_);
    last_ = seen.t;

    const ParameterSet::Logs logs = parameters_.logs();
    State mean = states_.mean();
    mean += parameters_.sensitivity().leftCols(set_.size()) * (logs - old);
    states_.reset(mean, states_.squareRoot());
    const CameraPose pose = parameters_.pose();
    const estimation::Lower<3> root =
        (seen.tip_covariance / innovation.weight).llt().matrixL().toDenseMatrix();
    states_.update(TipMeasurement{arm_, pose, centre_}, seen.tip, root);
    const Matrix3d whole = noise + seen.tip_covariance / innovation.weight;
    const Eigen::Matrix<double, 6, 3> gain = whole.llt().solve(by_state * covariance).transpose();
    parameters_.correctSensitivity(gain * by_state);
    retune(logs);
  }

  TracePoint tracePoint() const {
    TracePoint point;
    point.t = t_;
    point.log = parameters_.logs();
    const auto covariance = parameters_.covariance();
    const ParameterFilter::Unknowns sigma =
        spread_.factors(covariance).cwiseProduct(covariance.diagonal().cwiseSqrt()).cwiseMin(1.0);
    point.sigma = parameters_.scale().cwiseProduct(sigma).head(set_.size());
    return point;
  }

  const ParameterFilter& parameters() const { return parameters_; }
  const ScoreSpread& spread() const { return spread_; }
  const Tally& tally() const { return tally_; }
  std::uint64_t rescues() const { return parameters_.rescues() + states_.rescues(); }
  double nis() const { return count_ > 0 ? nis_ / count_ : std::numeric_limits<double>::quiet_NaN(); }
  double outliers() const { return count_ > 0 ? static_cast<double>(held_back_) / count_ : 0.0; }
  int count() const { return count_; }

 private:
  void start(std::size_t sample) {
    const MotorTrack& motors = data_.motors;
    at_ = sample;
    t_ = motors.t[sample];
    const auto q =
        robot::Transmission(set_.robot(parameters_.logs())).jointFromMotor(motors.position[sample]);
    State mean = State::Zero();
    estimation::Lower<6> root = estimation::Lower<6>::Zero();
    for (int i = 0; i < 3; ++i) {
      mean(2 * i) = q(i);
      root(2 * i, 2 * i) = i < 2 ? kStartPosition : 0.1 * kStartPosition;
      root(2 * i + 1, 2 * i + 1) = i < 2 ? kStartSpeed : 0.1 * kStartSpeed;
    }
    states_.reset(mean, root);
    parameters_.forgetSensitivity();
    interval_.steps.clear();
  }

  /// Advances within the step from motor sample at_ to the next; speed is the difference quotient
  /// (shooting.h).
  void step(double end) {
    const MotorTrack& motors = data_.motors;
    const double whole = motors.t[at_ + 1] - motors.t[at_];
    const Vector3d speed = (motors.position[at_ + 1] - motors.position[at_]) / whole;
    const auto here = [&](double t) {
      return tracking::MotorState{motors.position[at_] + (t - motors.t[at_]) * speed, speed};
    };
    const MotorInterval::Step step{tracking::CableArmModel::interval(here(t_), here(end)), end - t_};
    estimation::Lower<6> noise = estimation::Lower<6>::Zero();
    for (int i = 0; i < 3; ++i) {
      noise(2 * i, 2 * i) = kPositionNoise(i) * std::sqrt(step.dt);
      noise(2 * i + 1, 2 * i + 1) = kVelocityNoise(i) * std::sqrt(step.dt);
    }
    states_.predict(model_, step.drive, step.dt, noise);
    interval_.steps.push_back(step);
    t_ = end;
  }

  /// d measured tip / d state for the camera of `pose`.
  Eigen::Matrix<double, 3, 6> tipByState(const CameraPose& pose) const {
    const State& x = states_.mean();
    const Vector3d q(x(0), x(2), x(4)), dq(x(1), x(3), x(5));
    Eigen::Matrix<double, 3, 6> by_state;
    const Matrix3d jacobian = arm_.tipJacobian(q - pose.delay * dq);
    for (int i = 0; i < 3; ++i) {
      by_state.col(2 * i) = jacobian.col(i);
      by_state.col(2 * i + 1) = -pose.delay * jacobian.col(i);
    }
    return by_state;
  }

  /// Change of the tip by an unknown force of one standard deviation on each joint [m].
  Matrix3d tipByDiscrepancy(const ParameterSet::Logs& logs) const {
    const State& x = states_.mean();
    return arm_.tipJacobian({x(0), x(2), x(4)}) *
           errorByDiscrepancy(set_.constants(logs), options_.discrepancy);
  }

  void retune(const ParameterSet::Logs& logs) {
    constexpr double kTolerance = 0.05;
    if (rate_ == 0.0 || (logs - rate_at_).cwiseAbs().maxCoeff() > kTolerance) {
      rate_at_ = logs;
      rate_ = std::exp(kTolerance) * set_.rate(logs);
    }
    model_.setConstants(set_.constants(logs), rate_);
  }

  const IdentificationData& data_;
  const ParameterSet& set_;
  DualUkfOptions options_;
  robot::ArmKinematics arm_;
  tracking::CableArmModel model_;
  Vector3d centre_;
  estimation::SquareRootUkf<6> states_;
  ParameterFilter parameters_;
  ScoreSpread spread_;
  Tally tally_;
  MotorInterval interval_;
  std::size_t at_ = 0;
  double t_ = 0.0, last_ = 0.0;
  ParameterSet::Logs rate_at_;
  double rate_ = 0.0;
  double nis_ = 0.0;
  int count_ = 0, held_back_ = 0;
};

void describe(const Dual& dual, const ParameterSet& set, DualUkfReport& report) {
  const int n = set.size();
  const ParameterFilter& filter = dual.parameters();
  const auto covariance = filter.covariance();
  const ParameterFilter::Unknowns sigma = filter.scale().cwiseProduct(
      dual.spread().factors(covariance).cwiseProduct(covariance.diagonal().cwiseSqrt()));
  const Eigen::VectorXd inverse = covariance.diagonal().head(n).cwiseSqrt().cwiseInverse();
  report.correlation = inverse.asDiagonal() * covariance.topLeftCorner(n, n) * inverse.asDiagonal();
  report.camera = filter.pose();
  report.camera_sigma = cameraPoseOf(sigma.segment<CameraPose::kSize>(n));
  const int delay = n + CameraPose::kSize - 1;
  report.delay_noise = filter.scale()(delay) * std::sqrt(covariance(delay, delay));
  const TracePoint last = dual.tracePoint();
  for (int i = 0; i < n; ++i) {
    const bool seen = last.sigma(i) < kSeenShare * set[i].prior_sigma;
    Estimate estimate{set[i], last.log(i), last.sigma(i), seen, {}, {}};
    Visibility visibility = dual.tally().of(set[i], i, report.observations);
    visibility.sigma = filter.scale()(i) * std::sqrt(covariance(i, i));
    visibility.stated = last.sigma(i);
    findPartner(covariance, i, n + CameraPose::kSize, visibility);
    if (!seen) {
      estimate.weakness = weaknessOf(set, i, visibility, report.observations);
      estimate.advice = adviceFor(set, i, visibility, report.observations);
    }
    report.estimates.push_back(estimate);
    report.convergence.push_back(convergenceOf(report.trace, set, i));
  }
}

}  // namespace

DualUkfReport identifyDualUkf(const IdentificationData& data, const ParameterSet& set,
                              const DualUkfOptions& options, base::Progress* progress,
                              const TraceSink& sink) {
  const auto begin = std::chrono::steady_clock::now();
  DualUkfReport report;
  if (data.motors.size() < 2 || data.cameras.empty()) return report;
  Dual dual(data, set, options);
  report.end = DualUkfEnd::kRecordingEnded;
  const auto keep = [&] {
    report.trace.push_back(dual.tracePoint());
    if (sink) sink(report.trace.back());
  };
  keep();
  for (const CameraObservation& seen : data.cameras) {
    if (progress && progress->cancelled()) {
      report.end = DualUkfEnd::kCancelled;
      return report;
    }
    dual.advanceTo(seen.t);
    if (seen.open) dual.take(seen);
    report.used = seen.t - data.motors.t.front();
    if (progress) progress->report(report.used / data.duration(), "dual UKF");
    if (seen.t - report.trace.back().t >= kTracePeriod) keep();
  }
  if (dual.count() == 0) report.end = DualUkfEnd::kNoData;
  report.nis = dual.nis();
  report.outliers = dual.outliers();
  report.observations = dual.count();
  report.rescues = dual.rescues();
  describe(dual, set, report);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

}  // namespace capstan::identification
