/// The square-root UKF of the cable arm (six states, RK4, predict + update) against OpenCV's tracking UKF on
/// the same problem, and against the floor of 13 bare RK4 propagations. Prints one table of ratios measured
/// in this run, the distance to a long-double reference, and then Google Benchmark's own report.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/tracking/kalman_filters.hpp>
#include <string>
#include <vector>

#include "tests/benchmarks/ukf_problem.h"
#include "tests/support/cable_arm_reference.h"
#include "tests/support/ukf_reference.h"

namespace {

using namespace capstan::bench;
using capstan::estimation::Lower;
using capstan::math::InstructionSet;

/// A candidate model takes sample k -> k + 1 each time it is called; begin() goes back to the first.
class CandidateModel {
 public:
  CandidateModel(std::string title, int steps) : title_(std::move(title)), problem_(problemFor(steps)) {}
  virtual ~CandidateModel() = default;
  virtual void begin() = 0;
  virtual void step(int k) = 0;
  virtual double result() const = 0;
  const std::string& title() const { return title_; }
  const Problem& problem() const { return problem_; }

 private:
  std::string title_;
  const Problem& problem_;
};

class Ours : public CandidateModel {
 public:
  Ours(InstructionSet set, int steps, std::string title)
      : CandidateModel(std::move(title), steps), model_(problem().robot, set) {
    model_.setSteps(steps);
    sqrt_q_ = problem().sigma_q.asDiagonal();
    sqrt_r_ = problem().sigma_r.asDiagonal();
  }
  void begin() override { filter_.reset(problem().mean0, Lower<6>(problem().sigma0.asDiagonal())); }
  void step(int k) override {
    const auto& motor = problem().motor;
    const std::size_t at = static_cast<std::size_t>(k);
    filter_.predict(model_, CableArmModel::interval(motor[at], motor[at + 1]), problem().dt, sqrt_q_);
    benchmark::DoNotOptimize(filter_.update(problem().joints, problem().y[at + 1], sqrt_r_));
  }
  double result() const override { return filter_.mean()(0); }
  const Filter& filter() const { return filter_; }

 private:
  CableArmModel model_;
  Filter filter_;
  Lower<6> sqrt_q_;
  Lower<3> sqrt_r_;
};

class SimdFloor : public CandidateModel {
 public:
  SimdFloor(InstructionSet set, int steps, std::string title)
      : CandidateModel(std::move(title), steps), model_(problem().robot, set) {
    model_.setSteps(steps);
  }
  void begin() override { points_.colwise() = problem().mean0; }
  void step(int k) override {
    const auto& motor = problem().motor;
    const std::size_t at = static_cast<std::size_t>(k);
    model_.propagate(points_, CableArmModel::interval(motor[at], motor[at + 1]), problem().dt);
  }
  double result() const override { return points_(0, 0); }

 private:
  CableArmModel model_;
  alignas(64) CableArmModel::Points points_;
};

class ScalarFloor : public CandidateModel {
 public:
  explicit ScalarFloor(int steps) : CandidateModel("13 bare RK4, scalar", steps), arm_(steps) {}
  void begin() override { points_.colwise() = problem().mean0; }
  void step(int k) override {
    const auto& motor = problem().motor;
    const std::size_t at = static_cast<std::size_t>(k);
    const auto drive = CableArmModel::interval(motor[at], motor[at + 1]);
    for (int c = 0; c < 13; ++c) arm_.propagate(points_.col(c).data(), drive);
  }
  double result() const override { return points_(0, 0); }

 private:
  ScalarArm arm_;
  Eigen::Matrix<double, 6, 13> points_;
};

class OpenCvModel : public cv::detail::UkfSystemModel {
 public:
  explicit OpenCvModel(int steps) : arm_(steps) {}
  void stateConversionFunction(const cv::Mat& x, const cv::Mat& u, const cv::Mat&, cv::Mat& next) override {
    std::array<double, 6> state;  // x and next are columns of larger arrays
    for (int i = 0; i < 6; ++i) state[static_cast<std::size_t>(i)] = x.at<double>(i);
    arm_.propagate(state.data(), *reinterpret_cast<const capstan::tracking::CableArmDrive*>(u.ptr<double>()));
    for (int i = 0; i < 6; ++i) next.at<double>(i) = state[static_cast<std::size_t>(i)];
  }
  void measurementFunction(const cv::Mat& x, const cv::Mat&, cv::Mat& z) override {
    for (int i = 0; i < 3; ++i) z.at<double>(i) = x.at<double>(2 * i);
  }

 private:
  ScalarArm arm_;
};

class OpenCv : public CandidateModel {
 public:
  explicit OpenCv(int steps)
      : CandidateModel("OpenCV tracking UKF", steps), model_(cv::makePtr<OpenCvModel>(steps)) {}
  void begin() override {
    cv::detail::UnscentedKalmanFilterParams p;
    p.init(6, 3, 12, 1.0, 1.0, model_, CV_64F);
    p.alpha = capstan::estimation::SigmaRule::kAlpha;
    p.k = capstan::estimation::SigmaRule::kKappa;
    p.beta = capstan::estimation::SigmaRule::kBeta;
    for (int i = 0; i < 6; ++i) {
      p.stateInit.at<double>(i) = problem().mean0(i);
      p.errorCovInit.at<double>(i, i) = std::pow(problem().sigma0(i), 2);
      p.processNoiseCov.at<double>(i, i) = std::pow(problem().sigma_q(i), 2);
    }
    for (int i = 0; i < 3; ++i) p.measurementNoiseCov.at<double>(i, i) = std::pow(problem().sigma_r(i), 2);
    filter_ = cv::detail::createUnscentedKalmanFilter(p);
  }
  void step(int k) override {
    const auto& motor = problem().motor;
    const std::size_t at = static_cast<std::size_t>(k);
    auto drive = CableArmModel::interval(motor[at], motor[at + 1]);
    filter_->predict(cv::Mat(12, 1, CV_64F, &drive));
    Vector3 y = problem().y[at + 1];
    filter_->correct(cv::Mat(3, 1, CV_64F, y.data()));
  }
  double result() const override { return filter_->getState().at<double>(0); }
  cv::Mat state() const { return filter_->getState(); }

 private:
  cv::Ptr<OpenCvModel> model_;
  cv::Ptr<cv::detail::UnscentedKalmanFilter> filter_;
};

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

/// Nanoseconds a step of each candidate model: the fastest of several rounds, the candidate models taking
/// turns within a round.
std::vector<double> timeInTurns(const std::vector<std::unique_ptr<CandidateModel>>& candidate_models) {
  constexpr int kRounds = 25;
  using Clock = std::chrono::steady_clock;
  std::vector<double> fastest(candidate_models.size(), std::numeric_limits<double>::infinity());
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t c = 0; c < candidate_models.size(); ++c) {
      candidate_models[c]->begin();
      for (int k = 0; k < 100; ++k) candidate_models[c]->step(k);
      candidate_models[c]->begin();
      const auto start = Clock::now();
      for (int k = 0; k < kSamples; ++k) candidate_models[c]->step(k);
      const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count() / kSamples;
      fastest[c] = std::min(fastest[c], ns);
      benchmark::DoNotOptimize(candidate_models[c]->result());
    }
  return fastest;
}

/// Largest difference of the mean (absolute, rad or m and per second) and of the covariance (relative to its
/// norm) from the reference over `samples` steps; OpenCV's mean beside it.
void printAgreement(int steps, int samples) {
  using Real = long double;
  const Problem& problem = problemFor(steps);
  using Reference = capstan::test::CableArmReference<Real>;
  const Reference arm(problem.robot);
  capstan::test::UkfReference<Real, 6> reference;
  using RealState = Eigen::Matrix<Real, 6, 1>;
  using RealMatrix = Eigen::Matrix<Real, 6, 6>;
  const auto square = [](const auto& sigma) { return sigma.template cast<Real>().cwiseAbs2().eval(); };
  reference.reset(problem.mean0.cast<Real>(), RealMatrix(square(problem.sigma0).asDiagonal()));
  const RealMatrix q = square(problem.sigma_q).asDiagonal();
  const Eigen::Matrix<Real, 3, 3> r = square(problem.sigma_r).asDiagonal();
  Ours ours(capstan::math::bestInstructionSet(), steps, "");
  OpenCv opencv(steps);
  ours.begin();
  opencv.begin();
  double mean = 0.0, covariance = 0.0, theirs = 0.0;
  const auto real = [](const MotorState& m) {
    return Reference::Motor{m.position.cast<Real>(), m.velocity.cast<Real>()};
  };
  for (int k = 0; k < samples; ++k) {
    const std::size_t at = static_cast<std::size_t>(k);
    const auto begin = real(problem.motor[at]), end = real(problem.motor[at + 1]);
    reference.predict(
        [&](const RealState& x) { return arm.propagate(x, begin, end, Real(problem.dt), steps); }, q);
    reference.update<3>([](const RealState& x) { return Eigen::Matrix<Real, 3, 1>(x(0), x(2), x(4)); },
                        problem.y[at + 1].cast<Real>(), r);
    ours.step(k);
    opencv.step(k);
    const Vector6 expected = reference.mean().cast<double>();
    mean = std::max(mean, (ours.filter().mean() - expected).cwiseAbs().maxCoeff());
    const Eigen::Matrix<double, 6, 6> p = reference.covariance().cast<double>();
    covariance = std::max(covariance, (ours.filter().covariance() - p).norm() / p.norm());
    for (int i = 0; i < 6; ++i)
      theirs = std::max(theirs, std::abs(opencv.state().at<double>(i) - expected(i)));
  }
  std::printf(
      "Largest distance to the long-double reference over %d steps: mean %.2g, covariance %.2g (relative); "
      "OpenCV's mean %.2g\n",
      samples, mean, covariance, theirs);
}

std::vector<std::unique_ptr<CandidateModel>> contendersFor(int steps) {
  std::vector<std::unique_ptr<CandidateModel>> list;
  list.push_back(
      std::make_unique<Ours>(capstan::math::bestInstructionSet(), steps, "srUKF predict + update"));
  list.push_back(std::make_unique<OpenCv>(steps));
  list.push_back(std::make_unique<ScalarFloor>(steps));
  list.push_back(
      std::make_unique<SimdFloor>(capstan::math::bestInstructionSet(), steps, "13 bare RK4, side by side"));
  for (const InstructionSet set : capstan::math::kInstructionSets)
    if (capstan::math::isAvailable(set) && set != capstan::math::bestInstructionSet())
      list.push_back(std::make_unique<Ours>(
          set, steps, std::string("srUKF, propagation in ") + capstan::math::nameOf(set)));
  return list;
}

void printTable(int steps) {
  const auto candidate_models = contendersFor(steps);
  const std::vector<double> ns = timeInTurns(candidate_models);
  std::printf("\nA sample of %g ms in %d RK4 step%s\n", 1e3 * problemFor(steps).dt, steps,
              steps == 1 ? "" : "s");
  for (std::size_t c = 0; c < candidate_models.size(); ++c)
    std::printf("  %-38s %9.0f ns  %6.2f x srUKF\n", candidate_models[c]->title().c_str(), ns[c],
                ns[c] / ns[0]);
  std::printf(
      "  faster than OpenCV: %.1f x (wanted: 8)   srUKF over floor: %.2f x scalar, %.2f x side by side "
      "(wanted: 2.5)\n",
      ns[1] / ns[0], ns[0] / ns[2], ns[0] / ns[3]);
  printAgreement(steps, 1000);
}

void run(benchmark::State& state, const std::function<std::unique_ptr<CandidateModel>()>& make) {
  const auto contender = make();
  contender->begin();
  int k = 0;
  for (auto _ : state) {
    if (k == kSamples) contender->begin(), k = 0;
    contender->step(k++);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  cv::setNumThreads(1);
  const int real = CableArmModel(problemFor(0).robot).stepsFor(kPeriod);
  std::printf("Processor: %s; kernels: %s\n", processorName().c_str(),
              capstan::math::nameOf(capstan::math::bestInstructionSet()));
  printTable(1);
  printTable(real);
  std::printf("\n");
  for (const int steps : {1, real}) {
    const std::string suffix = "/substeps:" + std::to_string(steps);
    benchmark::RegisterBenchmark(("srUKF" + suffix).c_str(), [steps](benchmark::State& state) {
      run(state, [&] { return std::make_unique<Ours>(capstan::math::bestInstructionSet(), steps, ""); });
    });
    benchmark::RegisterBenchmark(("OpenCV_UKF" + suffix).c_str(), [steps](benchmark::State& state) {
      run(state, [&] { return std::make_unique<OpenCv>(steps); });
    });
    benchmark::RegisterBenchmark(("RK4_13_scalar" + suffix).c_str(), [steps](benchmark::State& state) {
      run(state, [&] { return std::make_unique<ScalarFloor>(steps); });
    });
    benchmark::RegisterBenchmark(("RK4_13_side_by_side" + suffix).c_str(), [steps](benchmark::State& state) {
      run(state, [&] { return std::make_unique<SimdFloor>(capstan::math::bestInstructionSet(), steps, ""); });
    });
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
