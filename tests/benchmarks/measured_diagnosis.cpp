// measured_diagnosis [--data FOLDER] [--threads 2]: diagnoses recordings of two real robots whose structure
// is taken for simpler than it is, and prints what is named, in which order, with errors on data that were
// not fitted after each step beside published ones. What is not in FOLDER is skipped.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>

#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/selection/horizons.h"
#include "tests/support/folders.h"
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

void printErrors(const std::string& name, const measured::EmpsErrors& train,
                 const measured::EmpsErrors& test) {
  fmt::print("  {:40}{:>10.2f}{:>10.2f}{:>18.2f}{:>10.2f}\n", name, train.at_rest, test.at_rest, train.moving,
             test.moving);
}

void emps(const std::filesystem::path& folder, measured::EmpsStart start, int threads) {
  if (!isHere(folder / "train.csv") || !isHere(folder / "test.csv")) return;
  const auto& horizons = diagnosis::kHorizons;
  fmt::print(
      "EMPS from the rigid drive of {}\n"
      "RMSE of the open-loop simulation of whole records [mm]. Effects are chosen, and numbers fitted, by\n"
      "simulations of the training record that restart every {:g} s, and confirmed with {:g} s. The "
      "hypothesis\n"
      "asymmetric_viscosity joined the library after errors on the test record had been seen.\n",
      start == measured::EmpsStart::kFourNumbers ? "four numbers (mass, viscous, Coulomb, offset)"
                                                 : "three numbers (mass, viscous, Coulomb)",
      fmt::join(horizons, " s, then every "), diagnosis::kFarHorizon);
  fmt::print("  {:40}{:>20}{:>28}\n", "", "from rest", "as the first 20 rows move");
  fmt::print("  {:40}{:>10}{:>10}{:>18}{:>10}\n", "", "training", "test", "training", "test");
  const auto steps = measured::empsSteps(folder, start, threads);
  for (const measured::EmpsStep& step : steps)
    printErrors(named(step.name, step.competitors), step.train, step.test);
  fmt::print("  the same, numbers refitted to the simulation of the whole training record\n");
  for (const measured::EmpsStep& step : steps) printErrors(step.name, step.whole_train, step.whole_test);
  fmt::print(
      "  others, test: four-number drive 9.4; with asymmetric and speed-dependent friction 4.2; best "
      "published\n"
      "  2.64; black boxes 5.2 to 5.5\n");
  printNumbers(steps.back().robot);
}

void printErrors(const std::string& name, const measured::JawErrors& errors) {
  fmt::print("  {:50}{:>8.3f}{:>8.3f}{:>18.3f}\n", name, errors.even, errors.odd, errors.odd_zero_each);
}

/// One table per jaw; then the effects of each jaw with their numbers fitted to each other one.
void jaws(const std::filesystem::path& data, const std::vector<std::string>& frequencies, int threads) {
  const std::vector<std::filesystem::path> folders = measured::jawFolders(data);
  if (folders.empty()) isHere(data / "davinci-jaw");
  std::vector<std::unique_ptr<measured::Jaw>> all;
  std::vector<diagnosis::Selection> selections;
  for (const std::filesystem::path& folder : folders) {
    all.push_back(std::make_unique<measured::Jaw>(folder, frequencies, threads));
    fmt::print(
        "{}, {} Hz, RMS [deg]. Effects are chosen, and numbers and one encoder zero for all "
        "recordings\n"
        "fitted, under even load levels.\n",
        folder.filename().string(), fmt::join(frequencies, " and "));
    fmt::print("  {:50}{:>8}{:>8}{:>18}\n", "load levels:", "even", "odd", "odd, a zero each");
    selections.push_back(all.back()->select({}));
    const auto steps = all.back()->steps(selections.back());
    for (const measured::JawStep& step : steps) printErrors(named(step.name, step.competitors), step.errors);
    printErrors("least squares: spindle angle", all.back()->regression(2));
    printErrors("least squares: and load", all.back()->regression(3));
    printErrors("least squares: and direction, load x direction", all.back()->regression(5));
    printErrors("least squares: and speed, spindle torque", all.back()->regression(7));
    printNumbers(steps.back().robot);
  }
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t other = 0; other < all.size(); ++other)
      if (other != k)
        printErrors(fmt::format("{} with the effects of {}", folders[k].filename().string(),
                                folders[other].filename().string()),
                    all[k]->transferred(selections[other]).errors);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = test::dataFolder().string();
  int threads = 2;
  CLI::App app("What diagnosis names in recordings of real robots");
  app.add_option("--data", data, "folder of measured data");
  std::string only;
  app.add_option("--only", only, "emps or jaws; default: both")->check(CLI::IsMember({"emps", "jaws"}));
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  try {
    if (only != "jaws")
      for (const auto start : {measured::EmpsStart::kFourNumbers, measured::EmpsStart::kThreeNumbers})
        emps(std::filesystem::path(data) / "emps", start, threads);
    if (only != "emps") jaws(data, {"0.1", "0.3"}, threads);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measured_diagnosis: %s\n", error.what());
    return 1;
  }
}
