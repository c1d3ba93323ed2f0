// diagnosis_study [--seeds 8] [--none 80] [--two 40] [--uncovered 30] [--threads 2] [--out DIR] …: plants
// every effect in robots, has each recording diagnosed and says how often the answer is right. Cases that DIR
// holds already are not run again, so that an interrupted study goes on where it stopped; --tables only
// counts what is there.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/software.h"
#include "core/diagnosis/diagnose.h"
#include "tests/support/planted_study/run_study.h"
#include "tests/support/planted_study/study_tables.h"

namespace {

using namespace capstan;

struct Wanted {
  study::StudyOptions cases;
  int threads = 2;
  std::string out = "diagnosis_study", robot = "all";
  bool tables = false, rigid = false;
};

/// The program; a build that no commit stands for is told by its bytes.
std::string program() {
  const std::string software = base::software();
  const bool exact = software.find('(') != std::string::npos && software.find("dirty") == std::string::npos;
  return exact ? software : software + " " + base::checksumOfFile("/proc/self/exe");
}

diagnosis::Report diagnosed(const std::vector<diagnosis::Evidence>& recordings,
                            const robot::Description& nominal) {
  diagnosis::DiagnosisOptions options;
  options.threads = 1;
  options.show = false;
  options.filter = false;
  options.material.length = 1e-5;  // the smallest planted effects are just visible, below the default
  return diagnosis::diagnose(recordings, nominal, options);
}

void tell(const study::Step& step) {
  const study::CaseOutcome& outcome = step.outcome;
  const study::NamedCause* first = study::firstCause(outcome.answer);
  std::fprintf(stderr, "%zu/%zu %s: %s%s (%.1f s; %.0f min left)\n", step.done, step.of,
               outcome.of.name().c_str(), outcome.answer.verdict.c_str(),
               first ? fmt::format(", {} {}", first->effect, first->joint).c_str() : "",
               outcome.answer.seconds, step.seconds_left / 60.0);
}

void run(const Wanted& wanted) {
  const std::filesystem::path folder = wanted.out;
  std::vector<study::StudyCase> cases = study::casesOf(wanted.cases);
  if (wanted.rigid)
    std::erase_if(cases, [](const study::StudyCase& one) { return one.robot == study::Robot::kRaven; });
  study::OutcomeFile file(folder / "cases.jsonl", program());
  for (const std::string& notice : file.notices()) std::fprintf(stderr, "%s\n", notice.c_str());
  if (!wanted.tables) study::runStudy(cases, diagnosed, wanted.threads, file, tell);
  std::vector<study::CaseOutcome> outcomes;
  for (const study::StudyCase& one : cases)
    if (auto outcome = file.find(one, wanted.tables)) outcomes.push_back(std::move(*outcome));
  const study::Summary summary = study::summaryOf(outcomes);
  study::writeTables(summary, folder);
  std::fputs(study::markdownOf(summary).c_str(), stdout);
}

void addOptions(CLI::App& app, Wanted& wanted) {
  app.add_option("--seeds", wanted.cases.seeds, "cases of each effect")->check(CLI::Range(0, 10000));
  app.add_option("--none", wanted.cases.none, "recordings without an effect")->check(CLI::Range(0, 100000));
  app.add_option("--two", wanted.cases.two, "with two effects")->check(CLI::Range(0, 100000));
  app.add_option("--uncovered", wanted.cases.uncovered, "with an effect that no hypothesis covers")
      ->check(CLI::Range(0, 100000));
  app.add_option("--first-seed", wanted.cases.first_seed, "another one: another study");
  app.add_option("--threads", wanted.threads)->check(CLI::Range(1, 256));
  app.add_option("--out", wanted.out, "folder of cases.jsonl and the tables");
  app.add_option("--only", wanted.cases.only, "effects, or none, two, uncovered");
  app.add_option("--robot", wanted.robot, "raven, arm, axis; all: mixed")
      ->check(CLI::IsMember({"raven", "arm", "axis", "all"}));
  app.add_flag("--rigid", wanted.rigid, "only those cases of the study whose robot is a rigid drive");
  app.add_flag("--tables", wanted.tables,
               "run nothing: tables of the cases that are there, whatever made them");
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("How often the diagnosis of a planted effect is right");
  addOptions(app, wanted);
  CLI11_PARSE(app, argc, argv);
  try {
    if (const auto robot = base::fromName<study::Robot>(wanted.robot)) wanted.cases.robots = {*robot};
    run(wanted);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "diagnosis_study: %s\n", error.what());
    return 1;
  }
}
