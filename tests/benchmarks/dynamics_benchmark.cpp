/// Forward dynamics of RAVEN-II's three joints: the closed form and the recursion for general chains against
/// every way that Orocos KDL offers. Contenders take turns over the same random states in one run; the table
/// shows each one's best and median round and the ratio to KDL's fastest. Then Google Benchmark's own report.
#include <benchmark/benchmark.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainhdsolver_vereshchagin.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/robot/arm_dynamics.h"
#include "core/robot/chain_dynamics.h"
#include "tests/core/robot/kdl_chain.h"
#include "tests/core/robot/robot_files.h"

namespace {

using namespace capstan::robot;  // NOLINT
using Eigen::Vector3d;
using testing::kdlArray;

constexpr std::size_t kStates = 256;
constexpr int kRounds = 41;
constexpr int kSweeps = 20;  ///< over all states, in a round

/// Random states, in the form that each side wants them.
struct Problem {
  Description robot = testing::raven();
  std::vector<Vector3d> q, dq, tau;
  std::vector<KDL::JntArray> kdl_q, kdl_dq, kdl_tau;

  Problem() {
    capstan::base::Random random(1);
    for (std::size_t i = 0; i < kStates; ++i) {
      q.push_back(testing::randomInside(random, robot));
      dq.push_back(testing::randomVector(random, 2.0));
      tau.push_back(testing::randomVector(random, 3.0));
      kdl_q.push_back(kdlArray(q.back()));
      kdl_dq.push_back(kdlArray(dq.back()));
      kdl_tau.push_back(kdlArray(tau.back()));
    }
  }
};

const Problem& problem() {
  static const Problem instance;
  return instance;
}

using Forward = std::function<Vector3d(std::size_t)>;

/// Recursive Newton–Euler bias and composite-body mass matrix, fixed-size Cholesky: the leanest composition.
Forward kdlByParts(const KDL::Chain& chain, const KDL::Vector& gravity) {
  struct Parts {
    KDL::ChainIdSolver_RNE newton_euler;
    KDL::ChainDynParam parameters;
    KDL::JntSpaceInertiaMatrix mass{3};
    KDL::JntArray bias{3}, still{3};
    KDL::Wrenches none = KDL::Wrenches(3, KDL::Wrench::Zero());
  };
  const std::shared_ptr<Parts> parts(
      new Parts{KDL::ChainIdSolver_RNE(chain, gravity), KDL::ChainDynParam(chain, gravity)});
  return [parts](std::size_t i) -> Vector3d {
    const Problem& p = problem();
    parts->newton_euler.CartToJnt(p.kdl_q[i], p.kdl_dq[i], parts->still, parts->none, parts->bias);
    parts->parameters.JntToMass(p.kdl_q[i], parts->mass);
    const Eigen::Matrix3d mass = parts->mass.data;
    return mass.llt().solve(Vector3d(p.kdl_tau[i].data - parts->bias.data));
  };
}

Forward kdlForwardSolver(const KDL::Chain& chain, const KDL::Vector& gravity) {
  auto solver = std::make_shared<KDL::ChainFdSolver_RNE>(chain, gravity);
  return [solver, none = KDL::Wrenches(3, KDL::Wrench::Zero()),
          ddq = KDL::JntArray(3)](std::size_t i) mutable -> Vector3d {
    const Problem& p = problem();
    solver->CartToJnt(p.kdl_q[i], p.kdl_dq[i], p.kdl_tau[i], none, ddq);
    return ddq.data;
  };
}

/// Vereshchagin's hybrid solver, its one constraint direction zero.
Forward kdlHybridSolver(const KDL::Chain& chain, const KDL::Vector& gravity) {
  auto solver =
      std::make_shared<KDL::ChainHdSolver_Vereshchagin>(chain, KDL::Twist(-gravity, KDL::Vector::Zero()), 1);
  return [solver, none = KDL::Wrenches(3, KDL::Wrench::Zero()), ddq = KDL::JntArray(3),
          direction = KDL::Jacobian(1), energy = KDL::JntArray(1),
          reaction = KDL::JntArray(3)](std::size_t i) mutable -> Vector3d {
    const Problem& p = problem();
    solver->CartToJnt(p.kdl_q[i], p.kdl_dq[i], ddq, direction, energy, none, p.kdl_tau[i], reaction);
    return ddq.data;
  };
}

struct CandidateModel {
  std::string title;
  bool kdl;
  std::function<Vector3d()> sweep;  ///< all states once; the sum keeps the work alive
  std::vector<double> rounds;       ///< [ns a call]

  double best() const { return *std::min_element(rounds.begin(), rounds.end()); }
  double median() const {
    std::vector<double> sorted = rounds;
    std::nth_element(sorted.begin(), sorted.begin() + kRounds / 2, sorted.end());
    return sorted[kRounds / 2];
  }
};

template <class F>
std::function<Vector3d()> sweepOf(F forward) {
  return [forward]() mutable {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < kStates; ++i) {
      Vector3d ddq = forward(i);
      benchmark::DoNotOptimize(ddq.data());
      sum += ddq;
    }
    return sum;
  };
}

/// The next state waits for this result, as in an integrator: what one call costs from input to output.
Vector3d chainedSweep(const ArmDynamics& arm) {
  const Problem& p = problem();
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < kStates; ++i) {
    const Vector3d q = p.q[i] + 1e-300 * sum;
    sum += arm.forward<double>(q, p.dq[i], p.tau[i]);
  }
  return sum;
}

std::vector<CandidateModel> candidate_models() {
  static const ArmDynamics arm(problem().robot);
  static const ChainDynamics general(problem().robot);
  static const KDL::Chain chain = testing::kdlChain(problem().robot);
  const KDL::Vector gravity = testing::kdlVector(problem().robot.gravity);
  const Problem& p = problem();
  return {
      {"closed form, three-joint arm",
       false,
       sweepOf([&](std::size_t i) { return arm.forward(p.q[i], p.dq[i], p.tau[i]); }),
       {}},
      {"closed form, each call awaiting the last", false, [] { return chainedSweep(arm); }, {}},
      {"recursive, any chain",
       false,
       sweepOf([&](std::size_t i) -> Vector3d { return general.forward(p.q[i], p.dq[i], p.tau[i]); }),
       {}},
      {"KDL ChainIdSolver_RNE + ChainDynParam", true, sweepOf(kdlByParts(chain, gravity)), {}},
      {"KDL ChainFdSolver_RNE", true, sweepOf(kdlForwardSolver(chain, gravity)), {}},
      {"KDL ChainHdSolver_Vereshchagin", true, sweepOf(kdlHybridSolver(chain, gravity)), {}},
  };
}

std::string cpuName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown CPU";
}

/// Everybody solves the same problem: sums over all states agree.
bool agree(std::vector<CandidateModel>& all) {
  const Vector3d first = all[0].sweep();
  return std::all_of(all.begin(), all.end(), [&](CandidateModel& c) {
    const double difference = (c.sweep() - first).norm() / first.norm();
    if (difference > 1e-9) std::printf("%s differs by %.1e\n", c.title.c_str(), difference);
    return difference <= 1e-9;
  });
}

void measure(std::vector<CandidateModel>& all) {
  using Clock = std::chrono::steady_clock;
  for (int round = 0; round < kRounds; ++round)
    for (CandidateModel& contender : all) {
      const auto start = Clock::now();
      for (int k = 0; k < kSweeps; ++k) benchmark::DoNotOptimize(contender.sweep());
      const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
      contender.rounds.push_back(spent.count() / (kSweeps * static_cast<double>(kStates)));
    }
}

void printTable(const std::vector<CandidateModel>& all) {
  double peer = 1e300, peer_median = 1e300;
  for (const CandidateModel& c : all)
    if (c.kdl) {
      peer = std::min(peer, c.best());
      peer_median = std::min(peer_median, c.median());
    }
  std::printf("forward dynamics of RAVEN-II's three joints on %s\n", cpuName().c_str());
  std::printf("%-42s %10s %10s %22s\n", "", "best ns", "median ns", "x KDL's best (median)");
  for (const CandidateModel& c : all)
    std::printf("%-42s %10.1f %10.1f %14.1f (%.1f)\n", c.title.c_str(), c.best(), c.median(), peer / c.best(),
                peer_median / c.median());
  std::printf("target: closed form at least 20 x KDL's: %s\n\n",
              peer_median >= 20.0 * all[0].median() ? "met" : "missed");
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<CandidateModel> all = candidate_models();
  if (!agree(all)) return 1;
  measure(all);
  printTable(all);
  for (CandidateModel& contender : all)
    benchmark::RegisterBenchmark(contender.title.c_str(), [&contender](benchmark::State& state) {
      for (auto _ : state) benchmark::DoNotOptimize(contender.sweep());
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kStates));
    });
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
