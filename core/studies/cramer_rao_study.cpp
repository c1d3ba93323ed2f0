#include "core/studies/cramer_rao_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/resource.h"
#include "core/base/workers.h"
#include "core/estimation/consistency.h"
#include "core/estimation/cramer_rao.h"
#include "core/estimation/square_root_ukf.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/transmission.h"
#include "core/simulation/camera_mounting.h"
#include "core/simulation/trajectory.h"
#include "core/stats/bootstrap.h"
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/camera_noise.h"
#include "core/tracking/partial_kinematics.h"
#include "core/vision/camera.h"
#include "core/vision/triangulation.h"

namespace capstan::studies {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using estimation::Lower;
using tracking::CableArmModel;
using Filter = estimation::SquareRootUkf<6>;
using State = CableArmModel::State;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Pixels = Eigen::Vector4d;

constexpr double kStep = 1e-3;          // time step [s]
constexpr std::size_t kBatches = 8;     // batches of runs; sums are in their order, for any number of threads
constexpr double kShortestTask = 80.0;  // a block transfer shorter than this moves fewer blocks [s]

Vector3d positionsOf(const State& x) { return {x(0), x(2), x(4)}; }

State statesOf(const Vector3d& q, const Vector3d& dq) {
  State x;
  for (int joint = 0; joint < 3; ++joint) x.segment<2>(2 * joint) << q(joint), dq(joint);
  return x;
}

/// Robot, cameras and movement, which are the same in every run.
class Scene {
 public:
  explicit Scene(const CramerRaoOptions& options);

  std::size_t steps() const { return inputs.size(); }
  /// True when a camera sample is taken at the end of step k.
  bool seenAfter(std::size_t k) const {
    const auto frames = [&](std::size_t ticks) {
      return std::floor(static_cast<double>(ticks) * kStep / tracking_options.camera_period);
    };
    return frames(k + 1) > frames(k);
  }
  /// Pixels of the marker: left u, v, right u, v [px].
  Pixels see(const Vector3d& q) const;
  /// Jacobian ∂ pixels / ∂ q.
  Eigen::Matrix<double, 4, 3> seeingJacobian(const Vector3d& q) const;
  /// q_cam and its covariance J⁻¹ Sigma_pixels J⁻ᵀ.
  std::optional<tracking::JointObservation> joints(const Pixels& pixels, const Vector3d& near) const;

  tracking::TrackingOptions tracking_options;
  robot::Description robot;
  CableArmModel model;
  State start;                     ///< mean of the first state
  State start_sigma, noise_sigma;  ///< standard deviations of the first state and of the noise per step
  std::vector<CableArmModel::Input> inputs;
  std::vector<Vector3d> nominal;  ///< joints at the end of each step, with unstretched cables

 private:
  robot::ArmKinematics arm_;
  vision::Triangulator triangulator_;
  Eigen::Isometry3d base_from_camera_;
  double pixel_sigma_;
};

robot::Description robotOf(const CramerRaoOptions& options) {
  robot::Description robot = robot::defaultDescription();
  if (options.coulomb_friction) return robot;
  for (robot::Joint& joint : robot.joints) joint.friction.coulomb = 0.0;
  return robot;
}

Scene::Scene(const CramerRaoOptions& options)
    : robot(robotOf(options)),
      model(robot),
      arm_(robot),
      triangulator_(
          vision::readStereoRig(base::resource("cameras/left.yaml"), base::resource("cameras/right.yaml"))),
      base_from_camera_(simulation::nominalBaseFromCamera(robot)),
      pixel_sigma_(options.pixel_sigma) {
  simulation::TrajectorySpec spec;
  spec.duration = std::max(kShortestTask, options.duration);
  const auto movement = simulation::makeTrajectory(spec, robot, options.seed);
  const robot::Transmission transmission(robot);
  const auto motorsAt = [&](double t) -> tracking::MotorState {
    const simulation::JointTarget target = movement->at(t);
    const Vector3d before = transmission.motorFromJoint(movement->at(t - kStep).position),
                   now = transmission.motorFromJoint(target.position);
    return {now, (now - before) / kStep};
  };
  const auto steps = static_cast<std::size_t>(std::lround(options.duration / kStep));
  for (std::size_t k = 0; k < steps; ++k) {
    const double t = static_cast<double>(k) * kStep;
    inputs.push_back(CableArmModel::interval(motorsAt(t), motorsAt(t + kStep)));
    nominal.push_back(movement->at(t + kStep).position);
  }
  start = statesOf(movement->at(0.0).position, Vector3d::Zero());
  start_sigma = statesOf(tracking_options.initial_position_sigma, tracking_options.initial_velocity_sigma);
  noise_sigma = std::sqrt(kStep) * statesOf(tracking_options.position_noise, tracking_options.velocity_noise);
}

Pixels Scene::see(const Vector3d& q) const {
  const vision::StereoRig& rig = triangulator_.rig();
  const Vector3d tip = base_from_camera_.inverse() * arm_.tip(q);
  const auto left = rig.left.project(tip), right = rig.right.project(rig.right_from_left * tip);
  Pixels seen;
  seen << left.value_or(Eigen::Vector2d::Zero()), right.value_or(Eigen::Vector2d::Zero());
  return seen;
}

Eigen::Matrix<double, 4, 3> Scene::seeingJacobian(const Vector3d& q) const {
  constexpr double kWidth = 1e-5;
  Eigen::Matrix<double, 4, 3> jacobian;
  for (int j = 0; j < 3; ++j) {
    const Vector3d step = kWidth * Vector3d::Unit(j);
    jacobian.col(j) = (see(q + step) - see(q - step)) / (2.0 * kWidth);
  }
  return jacobian;
}

std::optional<tracking::JointObservation> Scene::joints(const Pixels& pixels, const Vector3d& near) const {
  const vision::Triangulation found =
      triangulator_.triangulate(pixels.head<2>(), pixels.tail<2>(), pixel_sigma_, pixel_sigma_);
  if (!found.found()) return std::nullopt;
  const Matrix3d rotation = base_from_camera_.linear();
  const auto seen = tracking::observeJoints(arm_, base_from_camera_ * found.position,
                                            rotation * found.covariance * rotation.transpose(), near);
  if (!seen) return std::nullopt;
  return *seen;
}

/// Constant R: diagonal of the mean of the pixels' R over the movement.
Vector3d meanVariance(const Scene& scene) {
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (std::size_t k = 0; k < scene.steps(); ++k) {
    if (!scene.seenAfter(k)) continue;
    const auto seen = scene.joints(scene.see(scene.nominal[k]), scene.nominal[k]);
    if (!seen) continue;
    sum += seen->covariance.diagonal();
    count += 1.0;
  }
  return count > 0.0 ? Vector3d(sum / count) : Vector3d(Vector3d::Constant(1.0));
}

struct RunResult {
  std::array<Vector3d, kStatedNoises> mean_square{Vector3d::Zero(), Vector3d::Zero()};
  std::array<double, kStatedNoises> nees{}, nis{};  // sums
  Vector3d camera_square = Vector3d::Zero();        // sum
  std::uint64_t updates = 0, rescues = 0;
};

/// One truth and its filters.
class Run {
 public:
  Run(const Scene& scene, const CramerRaoOptions& options, const Vector3d& constant, std::uint64_t index)
      : scene_(scene),
        options_(options),
        random_(options.seed, "cramer-rao " + std::to_string(index)),
        truth_(scene.start) {
    roots_[1] = constant.cwiseSqrt().asDiagonal();
    for (Filter& filter : filters_) filter.reset(scene.start, Lower<6>(scene.start_sigma.asDiagonal()));
    truth_ += drawn(scene.start_sigma);
  }

  /// Runs the steps from `from` to `to` − 1, the range of `average`.
  void follow(std::size_t from, std::size_t to, estimation::CramerRaoAverage<6>& average) {
    const State width = statesOf(Vector3d(1e-6, 1e-6, 1e-7), Vector3d(1e-5, 1e-5, 1e-6));
    const Lower<6> noise = scene_.noise_sigma.asDiagonal();
    const auto settled = static_cast<std::size_t>(std::lround(options_.settling / kStep));
    for (std::size_t k = from; k < to; ++k) {
      const CableArmModel::Input& input = scene_.inputs[k];
      average.addTransition(k - from,
                            estimation::transitionJacobian(scene_.model, truth_, input, kStep, width));
      truth_ = scene_.model.propagateOne(truth_, input, kStep) + drawn(scene_.noise_sigma);
      for (Filter& filter : filters_) filter.predict(scene_.model, input, kStep, noise);
      if (scene_.seenAfter(k)) observe(k - from, average);
      if (k < settled) continue;
      for (std::size_t i = 0; i < kStatedNoises; ++i)
        result_.mean_square[i] += positionsOf(filters_[i].mean() - truth_).cwiseAbs2() /
                                  static_cast<double>(scene_.steps() - settled);
    }
    average.endRun();
  }

  /// Results after the last step.
  RunResult result() {
    for (std::size_t i = 0; i < kStatedNoises; ++i) {
      result_.nees[i] = estimation::nees<6>(filters_[i].mean() - truth_, filters_[i].squareRoot());
      result_.rescues += filters_[i].rescues();
    }
    return result_;
  }

 private:
  State drawn(const State& sigma) {
    return State::NullaryExpr([&](Eigen::Index i) { return random_.normal(0.0, sigma(i)); });
  }

  void observe(std::size_t step, estimation::CramerRaoAverage<6>& average) {
    const Vector3d q = positionsOf(truth_);
    const Eigen::Matrix<double, 4, 6> h = scene_.seeingJacobian(q) * positions_.h;
    average.addMeasurement(step, h.transpose() * h / (options_.pixel_sigma * options_.pixel_sigma));
    Pixels pixels = scene_.see(q);
    for (int i = 0; i < 4; ++i) pixels(i) += random_.normal(0.0, options_.pixel_sigma);
    const auto seen = scene_.joints(pixels, positionsOf(filters_[0].mean()));
    if (!seen) return;
    roots_[0] = Lower<3>(seen->covariance.llt().matrixL());
    for (std::size_t i = 0; i < kStatedNoises; ++i)
      result_.nis[i] += filters_[i].update(positions_, seen->position, roots_[i]).nis;
    result_.camera_square += (seen->position - q).cwiseAbs2();
    ++result_.updates;
  }

  const Scene& scene_;
  const CramerRaoOptions& options_;
  base::Random random_;
  State truth_;
  tracking::JointMeasurement positions_ = tracking::positionsOnly();
  std::array<Filter, kStatedNoises> filters_;
  std::array<Lower<3>, kStatedNoises> roots_{Lower<3>::Identity(), Lower<3>::Identity()};
  RunResult result_;
};

CramerRaoStudy summarise(const std::vector<RunResult>& all, const CramerRaoOptions& options,
                         const Vector3d& bound) {
  CramerRaoStudy study;
  study.runs = static_cast<int>(all.size());
  study.bound = bound;
  Vector3d camera = Vector3d::Zero();
  std::uint64_t updates = 0;
  for (const RunResult& run : all) {
    camera += run.camera_square;
    updates += run.updates;
    study.rescues += run.rescues;
  }
  const auto seen = static_cast<double>(std::max<std::uint64_t>(updates, 1));
  study.updates = updates / all.size();
  study.camera = (camera / seen).cwiseSqrt();
  base::Random random(options.seed, "cramer-rao bootstrap");
  for (std::size_t i = 0; i < kStatedNoises; ++i) {
    for (const RunResult& run : all) {
      study.nees[i] += run.nees[i] / (6.0 * static_cast<double>(all.size()));
      study.nis[i] += run.nis[i] / (3.0 * seen);
    }
    for (int joint = 0; joint < 3; ++joint) {
      std::vector<double> squares;
      for (const RunResult& run : all) squares.push_back(run.mean_square[i](joint));
      const auto rootMean = [](std::span<const double> values) {
        double sum = 0.0;
        for (const double value : values) sum += value;
        return std::sqrt(sum / static_cast<double>(values.size()));
      };
      const auto report = stats::bootstrap(squares, rootMean, {.block_length = 1}, random);
      study.rms[i](joint) = report.estimate;
      study.ratio[i](joint) = report.estimate / bound(joint);
      study.interval[i][static_cast<std::size_t>(joint)] = {report.interval.low / bound(joint),
                                                            report.interval.high / bound(joint)};
    }
  }
  return study;
}

/// All runs in parallel, one segment of time after the other.
class Ensemble {
 public:
  Ensemble(const Scene& scene, const CramerRaoOptions& options, const Vector3d& constant)
      : scene_(scene),
        options_(options),
        inverse_q_(scene.noise_sigma.cwiseAbs2().cwiseInverse().asDiagonal()),
        posterior_(Matrix6(scene.start_sigma.cwiseAbs2().cwiseInverse().asDiagonal())) {
    for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(options.runs); ++i)
      runs_.emplace_back(scene, options, constant, i);
  }

  /// Runs the steps from `from` to `to` − 1. Batches are summed in order, for any number of threads.
  void follow(std::size_t from, std::size_t to, const base::ProgressSlice& progress) {
    const std::size_t batches = std::min(kBatches, runs_.size());
    std::vector<estimation::CramerRaoAverage<6>> averages(batches, {to - from, inverse_q_});
    std::vector<base::Job> jobs;
    for (std::size_t batch = 0; batch < batches; ++batch)
      jobs.push_back({fmt::format("{:g} s of {:g} s", static_cast<double>(to) * kStep, options_.duration),
                      1.0, [&, batch](base::Progress& own) {
                        const std::size_t end = runs_.size() * (batch + 1) / batches;
                        for (std::size_t i = runs_.size() * batch / batches; i < end && !own.cancelled(); ++i)
                          runs_[i].follow(from, to, averages[batch]);
                      }});
    base::doAll(jobs, options_.threads, progress);
    if (progress.whole.cancelled()) return;
    for (std::size_t batch = 1; batch < batches; ++batch) averages[0].merge(averages[batch]);
    const auto bounds = averages[0].bounds(posterior_);
    const auto settled = static_cast<std::size_t>(std::lround(options_.settling / kStep));
    for (std::size_t k = std::max(from, settled); k < to; ++k) bounds_ += positionsOf(bounds[k - from]);
  }

  /// Square root of the mean bound after settling.
  Vector3d meanBound() const {
    const auto settled = static_cast<std::size_t>(std::lround(options_.settling / kStep));
    return (bounds_ / static_cast<double>(scene_.steps() - settled)).cwiseSqrt();
  }
  std::vector<RunResult> results() {
    std::vector<RunResult> all;
    for (Run& run : runs_) all.push_back(run.result());
    return all;
  }

 private:
  const Scene& scene_;
  const CramerRaoOptions& options_;
  Matrix6 inverse_q_;
  estimation::PosteriorInformation<6> posterior_;
  std::deque<Run> runs_;
  Vector3d bounds_ = Vector3d::Zero();  // sum
};

}  // namespace

CramerRaoStudy studyCramerRao(const CramerRaoOptions& options, base::Progress& progress) {
  const Scene scene(options);
  const Vector3d constant = meanVariance(scene);
  Ensemble ensemble(scene, options, constant);
  const auto segment = static_cast<std::size_t>(std::max(1L, std::lround(options.segment / kStep)));
  const auto share = [&](std::size_t step) {
    return static_cast<double>(step) / static_cast<double>(scene.steps());
  };
  for (std::size_t from = 0; from < scene.steps() && !progress.cancelled(); from += segment) {
    const std::size_t to = std::min(from + segment, scene.steps());
    ensemble.follow(from, to, {progress, share(from), share(to)});
  }
  if (progress.cancelled()) {
    CramerRaoStudy nothing;
    nothing.cancelled = true;
    return nothing;
  }
  CramerRaoStudy study = summarise(ensemble.results(), options, ensemble.meanBound());
  study.constant_sigma = constant.cwiseSqrt();
  return study;
}

}  // namespace capstan::studies
