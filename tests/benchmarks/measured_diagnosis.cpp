// measured_diagnosis [--data FOLDER] [--threads 2]: diagnoses recordings of two real robots whose structure
// is taken for simpler than it is, and prints what is named, in which order, with errors on data that were
// not fitted after each step beside published ones. What is not in FOLDER is skipped.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "tests/support/measured_diagnosis/emps.h"
#include "tests/support/measured_diagnosis/jaw.h"
#include "tests/support/measured_diagnosis/steps.h"

namespace {

using namespace capstan;

bool isHere(const std::filesystem::path& path) {
  if (std::filesystem::exists(path)) return true;
  fmt::print("skipped: {} is not on this machine\n\n", path.string());
  return false;
}

/// Effects and their numbers, "cable_compliance (compliance 0.0012)".
void printNumbers(const robot::Description& robot) {
  for (const robot::Effect& effect : robot.effects) {
    fmt::print("    {}:", effect.effect);
    for (const robot::EffectValue& value : effect.values)
      fmt::print(" {} {:.4g}", value.parameter, value.value);
    fmt::print("\n");
  }
}

void emps(const std::filesystem::path& folder, int threads) {
  if (!isHere(folder / "train.csv") || !isHere(folder / "test.csv")) return;
  fmt::print("EMPS, RMSE of the open-loop simulation [mm]; chosen and fitted on the training record alone\n");
  fmt::print("  {:34}{:>10}{:>10}\n", "", "training", "test");
  const auto steps = measured::empsSteps(folder, threads);
  for (const measured::EmpsStep& step : steps)
    fmt::print("  {:34}{:>10.2f}{:>10.2f}\n", step.name, step.train_mm, step.test_mm);
  fmt::print(
      "  published: best known 2.64; polynomial NARX 5.17; linear state space 5.53\n"
      "  the last one's effects, those that every robot has some of too:\n");
  printNumbers(steps.back().robot);
  fmt::print("\n");
}

void jaw(const std::filesystem::path& folder, const std::vector<std::string>& frequencies, int threads) {
  if (!isHere(folder)) return;
  fmt::print("da Vinci jaw, {} Hz, RMS under the odd load levels [deg]; chosen and fitted under the even\n",
             fmt::join(frequencies, " and "));
  fmt::print("  {:34}{:>22}{:>18}\n", "", "a zero each recording", "one zero for all");
  const auto steps = measured::jawSteps(folder, frequencies, threads);
  for (const measured::JawStep& step : steps)
    fmt::print("  {:34}{:>22.3f}{:>18.3f}\n", step.name, step.zero_each_deg, step.zero_once_deg);
  fmt::print(
      "  quick fits of others, one zero for all: gear ratio 2.88; with linear stretch 1.73; with Coulomb "
      "friction\n  too 1.16. The last one's effects, those that every robot has some of too:\n");
  printNumbers(steps.back().robot);
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = measured::dataFolder().string();
  int threads = 2;
  CLI::App app("What diagnosis names in recordings of real robots");
  app.add_option("--data", data, "folder of measured data");
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    emps(std::filesystem::path(data) / "emps", threads);
    jaw(std::filesystem::path(data) / "davinci-jaw", {"0.1", "0.3"}, threads);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measured_diagnosis: %s\n", error.what());
    return 1;
  }
}
