#include "tests/support/learning_study/latency.h"

#include <fmt/format.h>

#include <chrono>

#include "core/math/dense.h"
#include "core/stats/quantile.h"

namespace capstan::study {

void tellLatency(const LearningData& data, const LearningStudyOptions& options) {
  using learning::State;
  constexpr std::size_t kCommands = 300;
  const std::vector<State>& states = data.command.states;
  const auto model = learning::CorrectionModel::trained(learning::kept(states, learning::cleanStates(states)),
                                                        options.correction);
  math::setDenseThreads(1);
  const auto timed = [&](auto ask) {
    std::vector<double> seconds;
    for (std::size_t k = 0; k < kCommands; ++k) {
      const State& state = states[k * states.size() / kCommands];
      const auto begin = std::chrono::steady_clock::now();
      ask(state);
      seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    const std::vector<double> at = stats::quantiles(seconds, std::vector{0.5, 0.99});
    return fmt::format("{:.3f} ms, 99 % within {:.3f} ms", 1e3 * at[0], 1e3 * at[1]);
  };
  fmt::print(
      "\nOne command, one thread, {} members of {} inducing points: pose alone {}; with σ and confidence "
      "{}\n",
      model.processes().front().members().size(), model.processes().front().members().front().inducing(),
      timed([&](const State& s) { return model.correct(std::vector{s}); }),
      timed([&](const State& s) { return model.correct(s); }));
  math::setDenseThreads(options.correction.threads);
  const auto begin = std::chrono::steady_clock::now();
  const std::size_t n = model.correct(states).size();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  fmt::print("Side by side, {} threads: {:.0f} commands a second\n", options.correction.threads,
             static_cast<double>(n) / took.count());
}

}  // namespace capstan::study
