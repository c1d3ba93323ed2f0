// measured_diagnosis [--data FOLDER] [--threads 2]: diagnoses recordings of two real robots whose structure
// is taken for simpler than it is, and prints what is named, in which order, with errors on data that were
// not fitted after each step beside published ones. What is not in FOLDER is skipped.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "core/diagnosis/diagnose.h"
#include "tests/support/data_folder.h"
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

/// "+ backlash" or "+ backlash (or slack)".
std::string named(const std::string& name, const std::vector<std::string>& competitors) {
  return competitors.empty() ? name : fmt::format("{} (or {})", name, fmt::join(competitors, ", "));
}

void printNumbers(const robot::Description& robot) {
  fmt::print("  the last one's effects, with those that every robot has some of:\n");
  for (const robot::Effect& effect : robot.effects) {
    fmt::print("    {}:", effect.effect);
    for (const robot::EffectValue& value : effect.values)
      fmt::print(" {} {:.4g}", value.parameter, value.value);
    fmt::print("\n");
  }
  fmt::print("\n");
}

void emps(const std::filesystem::path& folder, measured::EmpsStart start, int threads) {
  if (!isHere(folder / "train.csv") || !isHere(folder / "test.csv")) return;
  fmt::print(
      "EMPS from the rigid drive of {}\n"
      "RMSE of the open-loop simulation of whole records [mm]. Effects are chosen by simulations of the "
      "training\n"
      "record that restart every {:g} s, then every {:g} s; numbers are fitted to that of the whole\n"
      "training record. The hypothesis asymmetric_viscosity joined the library after errors on the test\n"
      "record had been seen.\n",
      start == measured::EmpsStart::kFourNumbers ? "four numbers (mass, viscous, Coulomb, offset)"
                                                 : "three numbers (mass, viscous, Coulomb)",
      diagnosis::kNearHorizon, diagnosis::kFarHorizon);
  fmt::print("  {:40}{:>20}{:>28}\n", "", "from rest", "as the first 20 rows move");
  fmt::print("  {:40}{:>10}{:>10}{:>18}{:>10}\n", "", "training", "test", "training", "test");
  const auto steps = measured::empsSteps(folder, start, threads);
  for (const measured::EmpsStep& step : steps)
    fmt::print("  {:40}{:>10.2f}{:>10.2f}{:>18.2f}{:>10.2f}\n", named(step.name, step.competitors),
               step.train.at_rest, step.test.at_rest, step.train.moving, step.test.moving);
  fmt::print(
      "  others, test: four-number drive 9.4; with asymmetric and speed-dependent friction 4.2; best "
      "published\n"
      "  2.64; black boxes 5.2 to 5.5\n");
  printNumbers(steps.back().robot);
}

void jaw(const std::filesystem::path& folder, const std::vector<std::string>& frequencies, int threads) {
  if (!isHere(folder)) return;
  fmt::print(
      "da Vinci jaw, {} Hz, RMS [deg]. Effects are chosen, and numbers and one encoder zero for all "
      "recordings\n"
      "fitted, under even load levels.\n",
      fmt::join(frequencies, " and "));
  fmt::print("  {:50}{:>8}{:>8}{:>18}\n", "load levels:", "even", "odd", "odd, a zero each");
  const auto steps = measured::jawSteps(folder, frequencies, {}, threads);
  for (const measured::JawStep& step : steps)
    fmt::print("  {:50}{:>8.3f}{:>8.3f}{:>18.3f}\n", named(step.name, step.competitors), step.even_deg,
               step.odd_deg, step.odd_zero_each_deg);
  fmt::print(
      "  quick fits, odd levels: gear ratio alone 2.88; with linear stretch 1.73; with Coulomb friction too "
      "1.16\n");
  printNumbers(steps.back().robot);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = test::dataFolder().string();
  int threads = 2;
  CLI::App app("What diagnosis names in recordings of real robots");
  app.add_option("--data", data, "folder of measured data");
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    for (const auto start : {measured::EmpsStart::kFourNumbers, measured::EmpsStart::kThreeNumbers})
      emps(std::filesystem::path(data) / "emps", start, threads);
    jaw(std::filesystem::path(data) / "davinci-jaw", {"0.1", "0.3"}, threads);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measured_diagnosis: %s\n", error.what());
    return 1;
  }
}
