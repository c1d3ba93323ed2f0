// recorded_plants [--data FOLDER] [--threads 2]: diagnoses recordings of simulated RAVEN-IIs that another
// program made, each with one effect (folders plant and plant-textured of FOLDER, effects in truth.jsonl),
// and prints what is named beside what is there. What is not in FOLDER is skipped.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/report/shown.h"
#include "tests/support/folders.h"

namespace {

using namespace capstan;
using diagnosis::Cause;
using diagnosis::Report;
using diagnosis::Verdict;

/// One line of truth.jsonl.
struct Truth {
  std::string effect;  ///< name in robot files; "outside_spring" is none of them
  int joint = 0;       ///< from 1; 0: whole arm or camera
  std::string size;
  bool textured = false;  ///< each joint has the effects of isTexture()

  bool isHere(const std::string& name, int at) const { return name == effect && at == joint; }
};

bool isTexture(const std::string& effect) {
  return effect == "capstan_eccentricity" || effect == "asymmetric_friction" || effect == "stribeck_friction";
}

Truth truthFrom(const std::string& line) {
  const nlohmann::json json = nlohmann::json::parse(line);
  Truth truth{json.at("effect"), json.at("joint"), json.at("truth"), json.contains("texture")};
  if (truth.textured && truth.effect == "cable_creep") truth.effect = "zero_drift";  // a drift of the zero
  return truth;
}

std::string named(const Cause& cause) {
  std::string text = fmt::format("{} {}", cause.effect, cause.joint);
  for (const diagnosis::FoundParameter& parameter : cause.parameters)
    text += fmt::format("{} {}", &parameter == &cause.parameters.front() ? ":" : ",",
                        diagnosis::shownParameter(cause.effect, parameter));
  return text;
}

/// Whether the effect is in the tie of the first cause.
bool isTied(const Report& report, const Truth& truth) {
  return report.verdict == Verdict::kTie &&
         std::ranges::any_of(report.ties.front().causes,
                             [&](const Cause& cause) { return truth.isHere(cause.effect, cause.joint); });
}

/// "right", "tie", "not first", or what is wrong. Texture that is named is no error.
std::string judged(const Report& report, const Truth& truth) {
  std::vector<Cause> causes = report.causes;
  std::erase_if(causes, [&](const Cause& cause) {
    return truth.textured && isTexture(cause.effect) && !truth.isHere(cause.effect, cause.joint);
  });
  const bool unexplained = report.verdict == Verdict::kUnexplained;
  if (truth.effect == "none") return causes.empty() && !unexplained ? "right" : "false alarm";
  if (truth.effect == "outside_spring") return unexplained ? "right" : "wrong";
  if (unexplained) return "unexplained";
  if (isTied(report, truth)) return "tie";
  for (std::size_t k = 0; k < causes.size(); ++k)
    if (truth.isHere(causes[k].effect, causes[k].joint)) return k == 0 ? "right" : "not first";
  return "missed";
}

/// Diagnoses the recordings of a folder. Returns the number of right answers and that of recordings.
std::pair<int, int> study(const std::filesystem::path& folder, int threads) {
  const robot::Description robot = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  std::ifstream truths(folder / "truth.jsonl");
  diagnosis::DiagnosisOptions options;
  options.threads = threads;
  options.show = options.filter = false;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".csv") files.push_back(entry.path());
  std::ranges::sort(files);
  int right = 0, count = 0;
  std::string line;
  for (const std::filesystem::path& file : files) {
    if (!std::getline(truths, line))
      throw base::InputError({folder / "truth.jsonl", count + 1, "", "",
                              fmt::format("has no line for {}", file.filename().string()),
                              "It has a line for each recording, in the order of their names"});
    ++count;
    const Truth truth = truthFrom(line);
    const Report report = diagnosis::diagnose({diagnosis::readEvidence(file, robot)}, robot, options);
    const std::string result = judged(report, truth);
    right += result == "right";
    fmt::print("{:12} {:12} {} {} ({})\n", file.stem().string(), result, truth.effect, truth.joint,
               truth.size);
    fmt::print("  {}: {}\n", base::nameOf(report.verdict), report.summary);
    for (const Cause& cause : report.causes) fmt::print("  {}\n", named(cause));
    std::fflush(stdout);
  }
  return {right, count};
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = test::dataFolder().string();
  int threads = 2;
  CLI::App app("What diagnosis names in recordings of simulated robots that another program made");
  app.add_option("--data", data, "folder of measured data");
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  try {
    for (const char* name : {"plant", "plant-textured"}) {
      const std::filesystem::path folder = std::filesystem::path(data) / name;
      if (!std::filesystem::exists(folder / "truth.jsonl")) {
        fmt::print("skipped: {} is not on this machine\n", folder.string());
        continue;
      }
      const auto [right, count] = study(folder, threads);
      fmt::print("{}: right in {} of {}\n\n", name, right, count);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recorded_plants: %s\n", error.what());
    return 1;
  }
}
