/// Seconds that identification takes for a recording of 200 s, on one thread and on two, each method beside
/// the other; and what derivatives cost, beside central differences of the same predictions. Names the
/// processor.
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "core/identification/batch.h"
#include "core/identification/dual_ukf.h"
#include "core/simulation/simulation_request.h"
#include "tests/support/folders.h"

namespace {

using namespace capstan;
using namespace capstan::identification;
using Clock = std::chrono::steady_clock;

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

template <class Work>
double secondsOf(Work&& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

IdentificationData record(double duration) {
  simulation::SimulationRequest request;
  const std::string resources = test::sourceFile("resources");
  request.truth = resources + "/truth/laboratory.yaml";
  request.trajectory = resources + "/experiments/fls.yaml";
  request.duration = duration;
  request.images = false;
  simulation::SimulatedOptions options = simulation::optionsOf(request);
  options.truth.cameras.pixel_sigma = 0.04;
  simulation::SimulatedSource source(options);
  return collect(source);
}

void line(const std::string& what, double seconds, double peer, const std::string& beside) {
  fmt::print("{:<44}{:>10.2f}{:>10.2f} × {}\n", what, seconds, seconds / peer, beside);
}

void methods(const IdentificationData& data, const ParameterSet& set) {
  DualUkfReport dual;
  const double one = secondsOf([&] { dual = identifyDualUkf(data, set); });
  const double pair = secondsOf([&] {
    std::jthread other([&] { (void)identifyDualUkf(data, set); });
    (void)identifyDualUkf(data, set);
  });
  const auto batch = [&](int threads) {
    BatchOptions options;
    options.shooting.threads = threads;
    for (const Estimate& estimate : dual.estimates) options.start.push_back(estimate.log);
    return secondsOf([&] { (void)identifyBatch(data, set, options); });
  };
  line("dual UKF, 1 thread", one, one, "itself");
  line("dual UKF, 2 recordings on 2 threads, each", 0.5 * pair, one, "1 thread");
  const double batch_one = batch(1);
  line("batch behind it, 1 thread", batch_one, one, "dual UKF");
  line("batch behind it, 2 threads", batch(2), batch_one, "1 thread");
}

void derivatives(const IdentificationData& data, const ParameterSet& set) {
  const Shooting shooting(data, set, {.threads = 1});
  std::vector<ArmPrediction> out;
  const ParameterSet::Logs zero = ParameterSet::Logs::Zero(set.size());
  const double value = secondsOf([&] { shooting.predict(zero, false, out); });
  const double with = secondsOf([&] { shooting.predict(zero, true, out); });
  const double differences = secondsOf([&] {
    for (int i = 0; i < set.size(); ++i)
      for (const double step : {-1e-4, 1e-4}) {
        ParameterSet::Logs logs = zero;
        logs(i) = step;
        shooting.predict(logs, false, out);
      }
  });
  line("predictions", value, value, "itself");
  line(fmt::format("with derivatives by {} parameters", set.size()), with, value, "predictions");
  line("central differences", differences, with, "these derivatives");
}

}  // namespace

int main() {
  constexpr double kDuration = 200.0;
  const IdentificationData data = record(kDuration);
  const ParameterSet set(data.robot, "r_l,k_e,b_e,f_c");
  fmt::print("{}\nidentification, {:.0f} s, {} observations, {} parameters\n{:<44}{:>10}{:>10}\n",
             processor(), kDuration, data.openCount(), set.size(), "", "seconds", "ratio");
  methods(data, set);
  derivatives(data, set);
}
